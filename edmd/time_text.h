#pragma once

#include <string>

namespace vitrel {

/// Formats a time as "time 1.5" for messages. Times below 0 belong to the equilibration before the first sample.
inline std::string time_text(double time) {
  return "time " + std::to_string(time) + (time < 0 ? " (of the equilibration)" : "");
}

}  // namespace vitrel
