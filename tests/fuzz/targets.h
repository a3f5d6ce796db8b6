#pragma once

#include <string>
#include <vector>

/// @file
/// What is fuzzed: each reader of the program with the files that it reads.
namespace vitrel {
class Stream;
}

namespace vitrel::fuzz {

enum class Kind { text, bytes, hdf5 };

/// A file that is damaged, and commands that read it.
struct Target {
  std::string file;  ///< in the working folder
  Kind kind;
  std::vector<std::string> originals;              ///< contents of undamaged files
  std::vector<std::vector<std::string>> commands;  ///< one of them reads a damaged file
};

struct NamedTarget {
  std::string name;
  /// Writes the files that the commands need into the working folder, by running the program there.
  Target (*make)();
};

const std::vector<NamedTarget>& targets();

/// Writes a damaged file of the target into the working folder and returns the command to read it.
const std::vector<std::string>& write_input(const Target& target, Stream& stream);

}  // namespace vitrel::fuzz
