#include "bench/surveys/survey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "bench/surveys/timed_batches.h"
#include "tests/support/case_classes.h"

namespace vitrel::bench {
namespace {

const CaseClass& generic() {
  static const std::vector<CaseClass> classes = classes_named("generic");
  return classes.front();
}

/// Answers with the true time plus `delay`.
Method delayed(const std::string& name, double delay) {
  return {name, 0, [delay](const CollisionCase& asked) {
            const TrueContact truth = truth_of(asked);
            Prediction2 answer;
            if (truth.outcome == TrueContact::Outcome::none) return answer;
            answer.outcome = Outcome::contact;
            answer.time = static_cast<double>(truth.time) + delay * asked.horizon;
            return answer;
          }};
}

Method that_always_says(const std::string& name, Outcome outcome) {
  return {name, 0, [outcome](const CollisionCase&) {
            Prediction2 answer;
            answer.outcome = outcome;
            return answer;
          }};
}

const SurveyRow& row_of(const Survey& result, std::string_view method) {
  return *std::ranges::find(result.rows, method, &SurveyRow::method);
}

/// Keeps the processor busy for so many seconds.
void work_for(double seconds) {
  const double begin = processor_seconds();
  while (processor_seconds() - begin < seconds) {
  }
}

/// Time that passes only when it is told to.
struct Watch {
  double now = 0;
  TimedBatches::Clock clock() {
    return [this] { return now; };
  }
};

TEST(TimedBatches, GrowAsFarAsTheBudgetGoes) {
  Watch watch;
  constexpr double question = 0x1p-9;  // sums of it are exact
  TimedBatches timer(25 * question, watch.clock());
  std::vector<std::size_t> batches;
  std::size_t asked = 0;
  while (const std::size_t batch = timer.next(1000000 - asked)) {
    timer.run(batch, [&] { watch.now += question * static_cast<double>(batch); });
    batches.push_back(batch);
    asked += batch;
  }
  EXPECT_EQ(batches, (std::vector<std::size_t>{1, 2, 4, 8, 10}));
  EXPECT_EQ(timer.ns_per_call(), 1e9 * question);
}

TEST(TimedBatches, AskOneQuestionWhateverItCosts) {
  Watch watch;
  TimedBatches timer(1e-9, watch.clock());
  EXPECT_EQ(timer.next(10), 1u);
  timer.run(1, [&] { watch.now += 1e-4; });
  EXPECT_EQ(timer.next(9), 0u);
}

TEST(TimedBatches, CountTheBestOfThreeRuns) {
  Watch watch;
  TimedBatches timer(std::numeric_limits<double>::infinity(), watch.clock());
  timer.run(1, [] {});
  int run = 0;
  timer.run(100, [&] { watch.now += ++run == 2 ? 1e-5 : 1e-2; });
  EXPECT_EQ(run, 3);
  EXPECT_NEAR(timer.ns_per_call(), 1e4 / 101, 1e-3);
}

TEST(TimedBatches, MeasureByTheTimeOfTheProcess) {
  TimedBatches timer;
  timer.run(1, [] { work_for(0.002); });
  EXPECT_GE(timer.ns_per_call(), 2e6);
}

TEST(Survey, CountsEveryAnswerOnceAndMeasuresItsError) {
  constexpr std::uint64_t pairs = 150;
  const double delay = 1e-4;
  const SurveyRequest request{{{delayed("exact", 0)},
                               {delayed("late", delay)},
                               {that_always_says("blind", Outcome::none)},
                               {that_always_says("lost", Outcome::not_converged)}},
                              {generic()},
                              pairs,
                              5,
                              {}};
  const Survey result = survey(request, {});
  EXPECT_FALSE(result.stopped);
  ASSERT_EQ(result.rows.size(), 4u);
  for (const SurveyRow& row : result.rows) {
    EXPECT_EQ(row.pairs, pairs);
    EXPECT_EQ(row.case_class, "generic");
    EXPECT_EQ(std::accumulate(row.verdicts.begin(), row.verdicts.end(), std::uint64_t{0}), pairs);
  }
  const SurveyRow& exact = row_of(result, "exact");
  EXPECT_EQ(exact.count(Verdict::correct), pairs);
  EXPECT_LT(exact.largest_error, 1e-15);
  const SurveyRow& late = row_of(result, "late");
  EXPECT_GT(late.count(Verdict::late), pairs / 10);
  EXPECT_EQ(late.count(Verdict::correct) + late.count(Verdict::late), pairs);
  EXPECT_NEAR(late.median_error, delay, 1e-12);
  EXPECT_NEAR(late.largest_error, delay, 1e-12);
  EXPECT_EQ(late.contacts, late.count(Verdict::late));
  const SurveyRow& blind = row_of(result, "blind");
  EXPECT_EQ(blind.count(Verdict::missed), late.count(Verdict::late));
  EXPECT_TRUE(std::isnan(blind.largest_error));
  EXPECT_EQ(row_of(result, "lost").count(Verdict::not_converged), pairs);
}

TEST(Survey, KeepsTheFirstFailureOfEachMethodThatAppliesAtAll) {
  Method lost_at_times = delayed("lost at times", 0);
  lost_at_times.predict = [exact = lost_at_times.predict](const CollisionCase& asked) {
    Prediction2 answer = exact(asked);
    if (answer.outcome == Outcome::contact) answer.outcome = Outcome::not_converged;
    return answer;
  };
  const SurveyRequest request{{{delayed("exact", 0)},
                               {delayed("late", 1e-3)},
                               {lost_at_times},
                               {that_always_says("lost", Outcome::not_converged)}},
                              {generic()},
                              100,
                              5,
                              {}};
  const std::vector<FailingCase> failures = survey(request, {}).failures;
  ASSERT_EQ(failures.size(), 2u);
  const FailingCase& late = failures[0];
  EXPECT_EQ(late.method, "late");
  EXPECT_EQ(late.assessment.verdict, Verdict::late);
  // It can be made anew from class, seed and index, and none before it has a contact.
  for (std::uint64_t k = 0; k <= late.index; ++k) {
    const CollisionCase asked = make_case(generic(), request.seed, k);
    const TrueContact truth = truth_of(asked);
    EXPECT_EQ(truth.outcome == TrueContact::Outcome::contact, k == late.index) << k;
  }
  EXPECT_EQ(failures[1].method, "lost at times");
  EXPECT_EQ(failures[1].index, late.index);
}

TEST(Survey, ASlowMethodAnswersWhatItsTimeAllows) {
  Method slow = that_always_says("slow", Outcome::none);
  slow.predict = [](const CollisionCase&) {
    work_for(0.005);
    return Prediction2{};
  };
  const SurveyRequest request{
      {{that_always_says("fast", Outcome::none)}, {slow, 0.1}}, {generic()}, 500, 5, {}};
  const Survey result = survey(request, {});
  EXPECT_EQ(row_of(result, "fast").pairs, 500u);
  EXPECT_LE(row_of(result, "slow").pairs, 20u);
  EXPECT_GE(row_of(result, "slow").pairs, 1u);
  EXPECT_GE(row_of(result, "slow").ns_per_call, 5e6);
}

TEST(Survey, StopsOnRequestAndKeepsWhatIsDone) {
  const std::vector<CaseClass> classes(4, generic());
  RunControl control;
  double fraction = 0;
  control.on_progress = [&](const Progress& progress) { fraction = progress.fraction; };
  control.should_stop = [&] { return fraction >= 0.5; };
  const Survey result = survey({{{delayed("exact", 0)}}, classes, 40, 5, {}}, control);
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.rows.size(), 2u);
}

}  // namespace
}  // namespace vitrel::bench
