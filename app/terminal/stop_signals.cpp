#include "app/terminal/stop_signals.h"

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <string>

#include "app/terminal/exit_codes.h"
#include "core/io/atomic_file.h"
#include "core/io/checked.h"
#include "workflow/sweep/process.h"

namespace vitrel {
namespace {

constexpr unsigned grace_seconds = 1;

volatile std::sig_atomic_t stop_asked = 0;
std::string summary_text;
const char* volatile summary_of_stop = "";
volatile std::sig_atomic_t has_deadline = 0, ends_at_once = 0;

// Handlers may only make async-signal-safe calls.

void print(const char* text, int descriptor = STDERR_FILENO) {
  [[maybe_unused]] const auto written = write(descriptor, text, std::strlen(text));
}

[[noreturn]] void end(const char* text) {
  if (isatty(STDERR_FILENO)) print("\r\033[K");  // erases the line of progress
  print(text);
  print(summary_of_stop, STDOUT_FILENO);
  remove_unfinished_files();
  _exit(stopped);
}

extern "C" void ask_to_stop(int number) {
  if (ends_at_once) end("stopped; the same command begins again\n");
  if (!stop_asked && has_deadline) alarm(grace_seconds);
  stop_asked = 1;
  if (number == SIGINT) static_cast<void>(std::signal(SIGINT, SIG_DFL));
}

// The first alarm is the limit of wall time, the second the deadline after a request.
extern "C" void note_alarm(int number) {
  if (!stop_asked) return ask_to_stop(number);
  end("stopped at once, without the work since the last checkpoint; the same command continues\n");
}

bool is_ignored(int number) {
  struct sigaction action {};
  checked(sigaction(number, nullptr, &action), "sigaction");
  return action.sa_handler == SIG_IGN;
}

void handle(int number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  checked(sigemptyset(&action.sa_mask), "sigemptyset");
  action.sa_flags = SA_RESTART;
  checked(sigaction(number, &action, nullptr), "sigaction");
}

void set_alarm(double seconds) {
  constexpr double shortest = 1e-6, longest = 1e9;
  const double bounded = std::clamp(seconds, shortest, longest);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(bounded);
  timer.it_value.tv_usec =
      static_cast<suseconds_t>(std::ceil(1e6 * (bounded - std::floor(bounded))));
  checked(setitimer(ITIMER_REAL, &timer, nullptr), "setitimer");
}

}  // namespace

void catch_stop_signals(double wall_time, StopDeadline deadline) {
  has_deadline = deadline == StopDeadline::soon;
  ends_at_once = deadline == StopDeadline::at_once;
  const bool is_nohup = is_ignored(SIGHUP);
  for (const int number : stop_signals)
    if (number != SIGHUP || !is_nohup) handle(number, ask_to_stop);
  handle(SIGALRM, note_alarm);
  handle(SIGXFSZ, SIG_IGN);
  if (wall_time > 0) set_alarm(wall_time);
}

void set_summary_of_stop(const std::string& text) {
  summary_of_stop = "";
  summary_text = text;
  summary_of_stop = summary_text.c_str();
}

bool stop_requested() {
  return stop_asked != 0;
}

}  // namespace vitrel
