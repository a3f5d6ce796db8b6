#pragma once

#include "app/commands/options.h"

namespace vitrel {

struct PrepareOptions {
  PrintOptions print;
  ParameterOptions source;
  std::filesystem::path output;
  StartOptions start;
  int threads = 1;
  double wall_time = 0;      ///< seconds; 0: no limit
  std::string command_line;  ///< for the provenance
};

/// Returns the exit code, or throws one of the errors of core/error.h.
int prepare_command(const PrepareOptions& options);

}  // namespace vitrel
