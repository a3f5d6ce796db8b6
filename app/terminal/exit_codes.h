#pragma once

#include <functional>
#include <string>

namespace vitrel {

enum ExitCode {
  success = 0,
  defect = 1,  ///< an error nobody foresaw
  user_error = 2,
  file_error = 3,
  broken_invariant = 4,
  stopped = 5,  ///< on request or for want of time; the same command continues, but for benchmarks
};

/// Prints a message on standard error, after the name of the program, which is red on a terminal. Returns `code`.
int complain(const std::string& program, const std::string& message, int code);

/// What `work` returns; if it throws one of the errors of core/error.h, a complaint, and the exit code of that
/// error.
int exit_code_of(const std::string& program, const std::function<int()>& work);

}  // namespace vitrel
