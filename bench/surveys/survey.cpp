#include "bench/surveys/survey.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>

#include "bench/surveys/timed_batches.h"
#include "core/parallel.h"

namespace vitrel::bench {
namespace {

constexpr std::size_t first_block = 64, largest_block = 4096;

/// Calls work(k) for k = 0 … count − 1 on all processors, because the reference takes far longer than the methods.
void for_each_in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  in_parallel(count, all_cores, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) work(k);
  });
}

/// Some consecutive cases of a class with their true answers.
template <int Dim>
struct Block {
  std::uint64_t first = 0;
  std::vector<CollisionCaseOf<Dim>> cases;
  std::vector<TrueContactOf<Dim>> truths;
};

template <int Dim>
Block<Dim> make_block(const SurveyRequestOf<Dim>& request, const CaseClassOf<Dim>& of,
                      std::uint64_t first, std::size_t count) {
  Block<Dim> block{first, std::vector<CollisionCaseOf<Dim>>(count),
                   std::vector<TrueContactOf<Dim>>(count)};
  for_each_in_parallel(count, [&](std::size_t k) {
    const CollisionCaseOf<Dim>& asked = block.cases[k] = make_case(of, request.seed, first + k);
    block.truths[k] = truth_of(asked);
  });
  return block;
}

double median(std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The gravity of a failure. It is greatest if a contact is overlooked although the surfaces cross fast.
int gravity(const Assessment& failure) {
  if (failure.verdict == Verdict::not_converged) return 0;
  if (failure.degenerate) return 1;
  return failure.verdict == Verdict::late || failure.verdict == Verdict::missed ? 3 : 2;
}

/// The examination of one method on one class.
template <int Dim>
class Examination {
 public:
  Examination(const MethodOf<Dim>& method, const CaseClassOf<Dim>& of, double seconds,
              AllowedError tolerance)
      : method_(&method), of_(&of), tolerance_(tolerance), timer_(seconds) {
    row_.method = method.name;
    row_.tolerance = method.tolerance;
    row_.case_class = of.name;
    row_.aspect_ratio = of.aspect_ratio;
    row_.largest_error = row_.largest_gap_error = row_.largest_moot_gap =
        std::numeric_limits<double>::quiet_NaN();
  }

  bool is_over() const { return over_; }

  void take(const Block<Dim>& block, const RunControl& control,
            std::optional<FailingCaseOf<Dim>>& failure) {
    std::size_t done = 0;
    while (done < block.cases.size() && !control.stop_requested()) {
      const std::size_t batch = timer_.next(block.cases.size() - done);
      over_ = batch == 0;
      if (over_) return;
      answer(std::span(block.cases).subspan(done, batch));
      assess_answers(block, done, failure);
      done += batch;
    }
  }

  SurveyRow result() {
    row_.ns_per_call = timer_.ns_per_call();
    row_.median_error = median(errors_);
    return row_;
  }

  std::uint64_t pairs() const { return row_.pairs; }

 private:
  void answer(std::span<const CollisionCaseOf<Dim>> cases) {
    answers_.resize(cases.size());
    timer_.run(cases.size(), [&] { answer_all(cases); });
  }
  /// It is not inlined, because scripts/count_instructions counts its instructions.
  [[gnu::noinline]] void answer_all(std::span<const CollisionCaseOf<Dim>> cases) {
    for (std::size_t k = 0; k < cases.size(); ++k) answers_[k] = method_->predict(cases[k]);
  }

  void assess_answers(const Block<Dim>& block, std::size_t first,
                      std::optional<FailingCaseOf<Dim>>& failure) {
    assessments_.resize(answers_.size());
    for_each_in_parallel(answers_.size(), [&](std::size_t k) {
      assessments_[k] =
          assess(block.cases[first + k], block.truths[first + k], answers_[k], tolerance_);
    });
    for (std::size_t k = 0; k < answers_.size(); ++k) {
      record(assessments_[k], block.cases[first + k], block.truths[first + k]);
      if (is_better_failure(assessments_[k], failure))
        failure = FailingCaseOf<Dim>{
            method_->name,           *of_,        block.first + first + k, block.cases[first + k],
            block.truths[first + k], answers_[k], assessments_[k]};
    }
  }

  static bool is_better_failure(const Assessment& assessment,
                                const std::optional<FailingCaseOf<Dim>>& known) {
    return assessment.verdict != Verdict::correct &&
           (!known || gravity(assessment) > gravity(known->assessment));
  }

  void record(const Assessment& assessment, const CollisionCaseOf<Dim>& asked,
              const TrueContactOf<Dim>& truth) {
    const bool contact = truth.outcome == TrueContactOf<Dim>::Outcome::contact;
    const double gap = std::abs(assessment.gap_error);
    ++row_.pairs;
    ++row_.verdicts[static_cast<std::size_t>(assessment.verdict)];
    row_.degenerate += assessment.degenerate;
    row_.contacts += contact;
    const double error = std::abs(assessment.time_error) / asked.horizon;
    if (!assessment.degenerate && !std::isnan(error)) {
      row_.largest_error = std::fmax(row_.largest_error, error);
      errors_.push_back(error);
    }
    if (contact) row_.largest_gap_error = std::fmax(row_.largest_gap_error, gap / asked.gap_unit());
    if (assessment.degenerate || !contact)
      row_.largest_moot_gap = std::fmax(row_.largest_moot_gap, gap / asked.contact_gap());
  }

  const MethodOf<Dim>* method_;
  const CaseClassOf<Dim>* of_;
  AllowedError tolerance_;
  TimedBatches timer_;
  SurveyRow row_;
  std::vector<double> errors_;
  std::vector<Prediction<Dim>> answers_;
  std::vector<Assessment> assessments_;
  bool over_ = false;
};

template <int Dim>
void examine_class(const SurveyRequestOf<Dim>& request, std::size_t class_index,
                   const RunControl& control,
                   std::vector<std::optional<FailingCaseOf<Dim>>>& failures,
                   SurveyOf<Dim>& result) {
  const CaseClassOf<Dim>& of = request.classes[class_index];
  const auto classes = static_cast<double>(request.classes.size());
  std::vector<bool> failed_before;
  for (const auto& failure : failures) failed_before.push_back(failure.has_value());
  std::vector<Examination<Dim>> examinations;
  for (const CandidateOf<Dim>& candidate : request.candidates)
    examinations.emplace_back(candidate.method, of, candidate.seconds / classes, request.tolerance);
  std::size_t size = first_block;
  for (std::uint64_t done = 0; done < request.pairs && !control.stop_requested();) {
    if (std::ranges::all_of(examinations, &Examination<Dim>::is_over)) break;
    const Block<Dim> block = make_block(request, of, done, std::min(size, request.pairs - done));
    for (std::size_t k = 0; k < examinations.size(); ++k)
      if (!examinations[k].is_over()) examinations[k].take(block, control, failures[k]);
    done += block.cases.size();
    size = std::min(2 * size, largest_block);
    const double part = static_cast<double>(done) / static_cast<double>(request.pairs);
    const double progress = static_cast<double>(class_index) + part;
    control.report_progress(
        {progress / classes, progress * static_cast<double>(request.pairs), "pairs"});
  }
  for (std::size_t k = 0; k < examinations.size(); ++k) {
    if (examinations[k].pairs() == 0) continue;
    result.rows.push_back(examinations[k].result());
    if (!result.rows.back().applies() && !failed_before[k]) failures[k].reset();
  }
}

}  // namespace

template <int Dim>
SurveyOf<Dim> survey(const SurveyRequestOf<Dim>& request, const RunControl& control) {
  SurveyOf<Dim> result;
  std::vector<std::optional<FailingCaseOf<Dim>>> failures(request.candidates.size());
  for (std::size_t k = 0; k < request.classes.size() && !control.stop_requested(); ++k)
    examine_class(request, k, control, failures, result);
  for (const auto& failure : failures)
    if (failure) result.failures.push_back(*failure);
  result.stopped = control.stop_requested();
  return result;
}

template Survey survey(const SurveyRequest&, const RunControl&);
template SurveyOf<3> survey(const SurveyRequestOf<3>&, const RunControl&);

}  // namespace vitrel::bench
