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

/// What `work` returns; if it throws one of the errors of core/error.h, a message on standard error that
/// begins with the name of the program, and the exit code of that error.
int exit_code_of(const std::string& program, const std::function<int()>& work);

}  // namespace vitrel
