#pragma once

#include <functional>
#include <string>

namespace vitrel {

/// Receives a line of text for the user about every step of the work; may be empty.
using Log = std::function<void(const std::string& line)>;

inline void log_line(const Log& log, const std::string& line) {
  if (log) log(line);
}

}  // namespace vitrel
