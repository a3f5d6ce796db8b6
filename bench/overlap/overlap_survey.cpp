#include "bench/overlap/overlap_survey.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "bench/surveys/timed_batches.h"

namespace vitrel::bench {
namespace {

struct Asked {
  std::vector<OverlapCase> cases;
  std::vector<OverlapTruth> truths;
};

Asked make_cases(const OverlapSurveyRequest& request, const OverlapClass& of) {
  Asked asked;
  for (std::uint64_t k = 0; k < request.pairs; ++k) {
    const OverlapCase one = make_overlap_case(of, request.seed, k);
    const OverlapTruth truth = true_overlap(one);
    if (std::abs(truth.gap) < smallest_judged_gap * one.gap_unit()) continue;
    asked.cases.push_back(one);
    asked.truths.push_back(truth);
  }
  return asked;
}

void record(OverlapRow& row, const OverlapCase& asked, const OverlapTruth& truth, bool disjoint) {
  ++row.pairs;
  if (disjoint == truth.disjoint) return;
  ++(disjoint ? row.wrong_disjoint : row.wrong_overlap);
  row.largest_wrong_gap = std::max(row.largest_wrong_gap, std::abs(truth.gap) / asked.gap_unit());
}

OverlapRow examine(const OverlapCriterion& criterion, const OverlapClass& of, const Asked& asked,
                   double seconds, const RunControl& control) {
  OverlapRow row;
  row.method = criterion.name;
  row.vertices = criterion.vertices;
  row.case_class = of.name;
  row.aspect_ratio = of.aspect_ratio;
  TimedBatches timer(seconds);
  std::vector<char> answers(asked.cases.size());
  for (std::size_t done = 0; done < asked.cases.size() && !control.stop_requested();) {
    const std::size_t batch = timer.next(asked.cases.size() - done);
    if (batch == 0) break;
    timer.run(batch, [&] {
      for (std::size_t k = done; k < done + batch; ++k)
        answers[k] = static_cast<char>(criterion.disjoint(asked.cases[k]));
    });
    for (std::size_t k = done; k < done + batch; ++k)
      record(row, asked.cases[k], asked.truths[k], answers[k] != 0);
    done += batch;
  }
  row.ns_per_call = timer.ns_per_call();
  return row;
}

}  // namespace

OverlapSurvey survey_overlap(const OverlapSurveyRequest& request, const RunControl& control) {
  OverlapSurvey result;
  const auto classes = static_cast<double>(request.classes.size());
  for (std::size_t k = 0; k < request.classes.size() && !control.stop_requested(); ++k) {
    const OverlapClass& of = request.classes[k];
    const Asked asked = make_cases(request, of);
    for (const OverlapCriterion& criterion : request.criteria) {
      const OverlapRow row = examine(criterion, of, asked, request.seconds / classes, control);
      if (row.pairs > 0) result.rows.push_back(row);
    }
    const double done = static_cast<double>(k + 1);
    control.report_progress({done / classes, done * static_cast<double>(request.pairs), "pairs"});
  }
  result.stopped = control.stop_requested();
  return result;
}

}  // namespace vitrel::bench
