#pragma once

#include "bench/overlap/criterion.h"
#include "core/state/stage.h"

namespace vitrel::bench {

struct OverlapSurveyRequest {
  std::vector<OverlapCriterion> criteria;
  std::vector<OverlapClass> classes;
  std::uint64_t pairs = 1000;  ///< of each class
  double seconds = 1;          ///< that each criterion may take, all classes together
  std::uint64_t seed = 1;
};

/// Pairs whose gap is below this, in units of the smaller semi-minor axis, are left out: positions
/// and semi-axes in double precision do not carry a smaller gap, and two right criteria may differ.
inline constexpr double smallest_judged_gap = 1e-13;

struct OverlapRow {
  std::string method;
  int vertices = 0;
  std::string case_class;
  double aspect_ratio = 0;
  std::uint64_t pairs = 0;
  std::uint64_t wrong_overlap = 0;   ///< disjoint pairs called overlapping
  std::uint64_t wrong_disjoint = 0;  ///< overlapping pairs called disjoint
  double largest_wrong_gap = 0;      ///< |gap| of these, in units of the smaller semi-minor axis
  double ns_per_call = 0;

  std::uint64_t wrong() const { return wrong_overlap + wrong_disjoint; }
};

struct OverlapSurvey {
  std::vector<OverlapRow> rows;  ///< class by class, criteria in the order of the request
  bool stopped = false;
};

/// Asks every criterion about the same pairs; a slow one answers as many as its time allows.
OverlapSurvey survey_overlap(const OverlapSurveyRequest& request, const RunControl& control);

}  // namespace vitrel::bench
