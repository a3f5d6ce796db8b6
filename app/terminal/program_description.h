#pragma once

#include <string>
#include <vector>

namespace vitrel {

/// An option of a command, or an argument, which has no dashes.
struct OptionDescription {
  std::vector<std::string> names;     ///< "-o", "--output"; of an argument one
  std::string value;                  ///< what follows it, "FILE"; empty: nothing
  std::vector<std::string> choices;   ///< what the value must be one of; empty: anything
  std::vector<std::string> excludes;  ///< names of others
  std::string sentence;
  bool required = false;
  bool repeated = false;  ///< may be given several times
};

/// A command, which has either arguments or commands of its own.
struct CommandDescription {
  std::string name;
  std::string sentence;
  std::string footer;
  std::vector<OptionDescription> arguments, options;
  std::vector<CommandDescription> commands;
};

/// The command line of a program, as its help describes it, for texts about it. A value called file_value or
/// folder_value is the path of one.
struct ProgramDescription : CommandDescription {
  std::string version;
};

inline constexpr const char* file_value = "FILE";
inline constexpr const char* folder_value = "FOLDER";

/// A script by which bash 4 or later, with or without the package bash-completion, completes commands, options,
/// choices, files and folders. It holds all words itself and does not run the program.
std::string bash_completion(const ProgramDescription& program);

/// The same for zsh: a file `_<program>` in a folder of `fpath`, or a text to source after `compinit`.
std::string zsh_completion(const ProgramDescription& program);

/// The manual page in section 1, as roff with the macros `man`.
std::string manual_page(const ProgramDescription& program);

}  // namespace vitrel
