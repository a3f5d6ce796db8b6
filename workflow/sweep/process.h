#pragma once

#include <sys/types.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vitrel {

/// What asks the program for a clean stop: Ctrl-C, a terminal that is closed, a batch system or its warning that time
/// runs out, or the limit of processor time.
inline constexpr std::array<int, 5> stop_signals = {SIGINT, SIGHUP, SIGTERM, SIGUSR1, SIGXCPU};

/// One word of the shell: in single quotes it takes every character for itself.
std::string shell_word(const std::string& text);

/// A child process that does not outlive this one: if this process dies, however, the child is
/// killed. Must be started from the thread that lives as long as the child is wanted.
class ChildProcess {
 public:
  /// Standard output replaces the file `output`, standard error is added to `log`. Throws FileError
  /// if the files cannot be opened or no process can be made.
  ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& output,
               const std::filesystem::path& log);

  /// The exit code once the process has ended (128 + number after a signal), else nothing.
  std::optional<int> poll();
  /// Asks the process to stop cleanly (SIGTERM).
  void ask_to_stop();

 private:
  pid_t pid_;
  std::optional<int> exit_code_;
};

}  // namespace vitrel
