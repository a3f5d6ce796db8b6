#pragma once

#include <functional>
#include <string>

namespace vitrel {

enum ExitCode {
  success = 0,
  defect = 1,  ///< an unforeseen error
  user_error = 2,
  file_error = 3,
  broken_invariant = 4,
  /// The user or a limit of time stopped the program; except for benchmarks, the same command continues.
  stopped = 5,
};

/// Prints a message on standard error after the name of the program, which is red on a terminal. Returns `code`.
int complain(const std::string& program, const std::string& message, int code);

/// Returns what `work` returns. If `work` throws one of the errors of core/error.h, prints a message and returns the
/// exit code of that error.
int exit_code_of(const std::string& program, const std::function<int()>& work);

}  // namespace vitrel
