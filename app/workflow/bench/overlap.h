#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/workflow/bench/chart.h"
#include "bench/lab/overlap/overlap_survey.h"

/// `vitrel bench overlap`: every criterion of overlap, asked about the same pairs.
namespace vitrel {

struct OverlapRequest {
  std::uint64_t pairs = 20000;  ///< of each class
  double seconds = 1;           ///< that a criterion may take
  std::uint64_t seed = 1;
  std::vector<std::string> methods;  ///< by name; empty: all
  std::vector<std::string> classes;  ///< likewise
};

/// Throws UserError for an unknown method or class.
lab::OverlapSurvey bench_overlap(const OverlapRequest& request, const RunControl& control);

nlohmann::ordered_json overlap_json(const std::vector<lab::OverlapRow>& rows);

/// The rows as lines, grouped by class; "·" stands for 0.
std::string overlap_text(const std::vector<lab::OverlapRow>& rows);

/// Time per call of pairs near contact against the largest gap judged wrongly on any class, for the
/// first aspect ratio; polygons are one series.
Chart overlap_chart(const std::vector<lab::OverlapRow>& rows);

}  // namespace vitrel
