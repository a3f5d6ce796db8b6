#pragma once

#include <string>

namespace vitrel {

struct ParamsOptions {
  std::string command;     ///< whose template is printed
  bool reference = false;  ///< print docs/parameters.md
};

/// Returns the exit code, or throws one of the errors of core/error.h.
int params_command(const ParamsOptions& options);

}  // namespace vitrel
