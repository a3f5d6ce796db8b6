#pragma once

namespace vitrel {

/// Runs the command that the command line names and returns the exit code.
int run_command_line(int count, char** words);

}  // namespace vitrel
