#pragma once

#include <sys/types.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vitrel {

/// The signals that request a clean stop: of Ctrl-C, of a terminal that closes, of a batch system that stops the job
/// or warns that time is running out, and of the limit of processor time.
inline constexpr std::array<int, 5> stop_signals = {SIGINT, SIGHUP, SIGTERM, SIGUSR1, SIGXCPU};

/// Quotes the text as one word of the shell. In single quotes every character stands for itself.
std::string shell_word(const std::string& text);

/// A child process that does not outlive this one: however this process dies, the child is killed. It must be started
/// from a thread that lives as long as the child is needed.
class ChildProcess {
 public:
  /// Starts the command. Its standard output replaces the file `output`, and its standard error is appended to `log`.
  /// Throws FileError if the files cannot be opened or the process cannot be created.
  ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& output,
               const std::filesystem::path& log);

  /// The exit code if the process has ended (128 + number after a signal), else no value.
  std::optional<int> poll();
  /// Asks the process to stop cleanly (SIGTERM).
  void ask_to_stop();

 private:
  pid_t pid_;
  std::optional<int> exit_code_;
};

}  // namespace vitrel
