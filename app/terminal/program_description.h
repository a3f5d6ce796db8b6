#pragma once

#include <string>
#include <vector>

namespace vitrel {

/// An option of a command, or an argument, whose name has no dashes.
struct OptionDescription {
  std::vector<std::string> names;     ///< "-o", "--output"; an argument has one name
  std::string value;                  ///< name of the value, such as "FILE"; empty if there is none
  std::vector<std::string> choices;   ///< all possible values; any value is possible if empty
  std::vector<std::string> excludes;  ///< names of options that exclude this one
  std::string sentence;
  bool required = false;
  bool repeated = false;  ///< whether it may be given several times
};

/// A command, which has either arguments or commands of its own.
struct CommandDescription {
  std::string name;
  std::string sentence;
  std::string footer;
  std::vector<OptionDescription> arguments, options;
  std::vector<CommandDescription> commands;
};

/// The command line of a program as its help describes it, as a source of other texts. A value named file_value or
/// folder_value is the path of a file or a folder.
struct ProgramDescription : CommandDescription {
  std::string version;
};

inline constexpr const char* file_value = "FILE";
inline constexpr const char* folder_value = "FOLDER";

/// A script that completes commands, options, choices, files and folders in bash 4 or later, with or without the
/// package bash-completion. It contains all words and does not run the program.
std::string bash_completion(const ProgramDescription& program);

/// A script that does this in zsh. It is a file `_<program>` in a folder of `fpath`, or is sourced after `compinit`.
std::string zsh_completion(const ProgramDescription& program);

/// The manual page in section 1, written in roff with the macros `man`.
std::string manual_page(const ProgramDescription& program);

}  // namespace vitrel
