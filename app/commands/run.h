#pragma once

#include "app/commands/options.h"

namespace vitrel {

struct RunOptions {
  PrintOptions print;
  ParameterOptions source;
  std::filesystem::path output;
  StartOptions start;
  bool dry_run = false;  ///< print what would be done
  int threads = 1;
  double wall_time = 0;      ///< seconds; 0: no limit
  std::string command_line;  ///< for the provenance
};

/// Returns the exit code, or throws one of the errors of core/error.h.
int run_command(const RunOptions& options);

}  // namespace vitrel
