#pragma once

#include "app/commands/options.h"

namespace vitrel {

struct AnalyzeOptions {
  PrintOptions print;
  AnalysisOptions analysis;
  bool list = false;             ///< what it computes, and nothing else
  std::filesystem::path input;   ///< run, or folder of a job or a sweep
  std::filesystem::path output;  ///< empty: beside the input
};

/// Returns the exit code, like all commands, or throws one of the errors of core/error.h.
int analyze_command(const AnalyzeOptions& options);

}  // namespace vitrel
