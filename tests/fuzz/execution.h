#pragma once

#include <string>
#include <vector>

namespace vitrel::fuzz {

struct Outcome {
  int code;
  std::string errors;  ///< what it wrote to standard error
};

/// As it is typed.
std::string command_line(const std::vector<std::string>& words);

/// Runs the program in this process, with these words after its name. Standard output is dropped.
Outcome execute(const std::vector<std::string>& words);

}  // namespace vitrel::fuzz
