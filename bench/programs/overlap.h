#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/overlap/overlap_survey.h"
#include "bench/programs/report.h"
#include "core/io/json.h"

namespace vitrel::bench {

struct OverlapOptions {
  std::uint64_t pairs = 20000;  ///< of each class
  double seconds = 1;           ///< that a criterion may take
  std::uint64_t seed = 1;
  std::vector<std::string> methods;  ///< by name; empty: all
  std::vector<std::string> classes;  ///< likewise
};

/// `vitrel-bench overlap`: every criterion of overlap, asked about the same pairs. Throws UserError for an
/// unknown criterion or class.
int overlap(const OverlapOptions& options, const OutputOptions& output);

OverlapSurvey measure_overlap(const OverlapOptions& options, Report& report);
Json overlap_json(const std::vector<OverlapRow>& rows);

}  // namespace vitrel::bench
