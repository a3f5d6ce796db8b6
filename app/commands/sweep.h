#pragma once

#include "app/commands/options.h"

namespace vitrel {

struct SweepOptions {
  PrintOptions print;
  ParameterOptions source;
  std::filesystem::path output;  ///< folder of the sweep
  int parallel = 0;              ///< jobs at a time; 0: not given
  double wall_time = 0;          ///< seconds; 0: no limit
  bool status = false;           ///< only print how far every job is
  std::string job;               ///< the only job to run; empty: all
  std::string export_as;  ///< program to write the sweep for instead of running it; empty: run
};

/// Returns the exit code, or throws one of the errors of core/error.h.
int sweep_command(const SweepOptions& options);

}  // namespace vitrel
