#pragma once

#include <string>
#include <vector>

namespace vitrel {

struct ParamsOptions {
  std::string command;     ///< whose template is printed
  bool reference = false;  ///< print docs/parameters.md
};

/// Those whose template can be printed.
std::vector<std::string> commands_with_templates();

/// Returns the exit code, or throws one of the errors of core/error.h.
int params_command(const ParamsOptions& options);

}  // namespace vitrel
