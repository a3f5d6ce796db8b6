#include "app/terminal/stop_signals.h"

#include <csignal>

#include "workflow/sweep/process.h"

namespace vitrel {
namespace {

volatile std::sig_atomic_t signalled = 0;

extern "C" void note_signal(int number) {
  signalled = 1;
  if (number == SIGINT) std::signal(SIGINT, SIG_DFL);
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = note_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int number : stop_signals) sigaction(number, &action, nullptr);
}

bool stop_signalled() {
  return signalled != 0;
}

}  // namespace vitrel
