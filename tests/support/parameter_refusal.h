#pragma once

#include <string>

#include "core/error.h"
#include "workflow/configuration/parameters.h"

namespace vitrel {

/// The message that refuses a parameter file of this text.
inline std::string refusal(const std::string& text) {
  try {
    parse_parameters(text, "file.toml");
  } catch (const UserError& error) {
    return error.what();
  }
  return "nothing was refused";
}

}  // namespace vitrel
