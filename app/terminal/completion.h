#pragma once

#include <string>

#include "app/terminal/program_description.h"

/// @file
/// Scripts by which shells complete commands, options, choices, files and folders. They hold all words themselves and do
/// not run the program.
namespace vitrel {

/// For bash 4 or later, with or without the package bash-completion.
std::string bash_completion(const ProgramDescription& program);

/// For zsh: a file `_<program>` in a folder of `fpath`, or a text to source after `compinit`.
std::string zsh_completion(const ProgramDescription& program);

}  // namespace vitrel
