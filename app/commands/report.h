#pragma once

#include "app/commands/options.h"

namespace vitrel {

struct ReportOptions {
  PrintOptions print;
  AnalysisOptions analysis;
  std::filesystem::path input;   ///< state, run, or folder of a job or a sweep
  std::filesystem::path output;  ///< empty: beside the input
};

/// Returns the exit code, or throws one of the errors of core/error.h.
int report_command(const ReportOptions& options);

}  // namespace vitrel
