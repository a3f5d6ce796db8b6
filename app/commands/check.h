#pragma once

#include "app/commands/options.h"

namespace vitrel {

struct CheckOptions {
  PrintOptions print;
  std::filesystem::path input;       ///< state or run
  std::filesystem::path parameters;  ///< of what the file does not say; may be empty
  bool last_only = false;            ///< the last frame only
};

/// Returns the exit code, or throws one of the errors of core/error.h.
int check_command(const CheckOptions& options);

}  // namespace vitrel
