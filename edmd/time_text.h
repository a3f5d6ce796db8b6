#pragma once

#include <string>

namespace vitrel {

/// "time 1.5" in messages. Times below 0 are those before the first sample.
inline std::string time_text(double time) {
  return "time " + std::to_string(time) + (time < 0 ? " (of the equilibration)" : "");
}

}  // namespace vitrel
