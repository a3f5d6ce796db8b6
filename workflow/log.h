#pragma once

#include <functional>
#include <string>

namespace vitrel {

/// Receives a line for a person about every step of a piece of work; may be empty.
using Log = std::function<void(const std::string& line)>;

inline void log_line(const Log& log, const std::string& line) {
  if (log) log(line);
}

}  // namespace vitrel
