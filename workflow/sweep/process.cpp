#include "workflow/sweep/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>

#include "core/error.h"
#include "core/io/checked.h"

namespace vitrel {
namespace {

int open_for_writing(const std::filesystem::path& path, int flags) {
  const int descriptor =
      open(path.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC | flags, 0666);
  if (descriptor < 0)
    throw FileError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
  return descriptor;
}

// Blocks the stop signals as long as it lives.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t stops;
    checked(sigemptyset(&stops), "sigemptyset");
    for (const int number : stop_signals) checked(sigaddset(&stops, number), "sigaddset");
    checked(sigprocmask(SIG_BLOCK, &stops, &before_), "sigprocmask");
  }
  ~HeldSignals() { static_cast<void>(restore()); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  // Called in the child, where a stop must end the process rather than call a handler, which exec would forget. A
  // hangup that is ignored (nohup) stays ignored.
  bool release_to_default() const {
    for (const int number : stop_signals) {
      const auto before = signal(number, SIG_DFL);
      const bool stays = before == SIG_IGN && number == SIGHUP;
      if (before == SIG_ERR || (stays && signal(number, SIG_IGN) == SIG_ERR)) return false;
    }
    return restore();
  }

 private:
  bool restore() const { return sigprocmask(SIG_SETMASK, &before_, nullptr) == 0; }

  sigset_t before_;
};

// Runs between fork and exec, where only async-signal-safe calls are allowed.
[[noreturn]] void become(char* const* arguments, int output, int log, pid_t parent,
                         const HeldSignals& held) {
  // The parent may have died before prctl asked for a signal at its death. The child gets a process group of its own,
  // because Ctrl-C on a terminal reaches the whole group, whereas the parent passes a stop on by itself.
  const bool is_ready = held.release_to_default() && prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 &&
                        getppid() == parent && setpgid(0, 0) == 0 &&
                        dup2(log, STDERR_FILENO) >= 0 && dup2(output, STDOUT_FILENO) >= 0;
  if (is_ready) static_cast<void>(execv(arguments[0], arguments));  // returns only if it fails
  constexpr std::string_view complaint = "the program cannot be started\n";
  [[maybe_unused]] const auto written = write(log, complaint.data(), complaint.size());
  _exit(127);
}

}  // namespace

std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

ChildProcess::ChildProcess(const std::vector<std::string>& command,
                           const std::filesystem::path& output, const std::filesystem::path& log) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int output_file = open_for_writing(output, O_TRUNC);
  const int log_file = open_for_writing(log, O_APPEND);
  const pid_t parent = getpid();
  const HeldSignals held;
  pid_ = fork();
  if (pid_ == 0) become(arguments.data(), output_file, log_file, parent, held);
  const int error = errno;
  static_cast<void>(close(output_file));
  static_cast<void>(close(log_file));
  if (pid_ < 0)
    throw FileError(fmt::format("{}: cannot be started: {}", command[0], std::strerror(error)));
}

std::optional<int> ChildProcess::poll() {
  if (exit_code_) return exit_code_;
  int status = 0;
  if (checked(waitpid(pid_, &status, WNOHANG), "waitpid") == pid_)
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return exit_code_;
}

void ChildProcess::ask_to_stop() {
  if (!exit_code_) checked(kill(pid_, SIGTERM), "kill");
}

}  // namespace vitrel
