#include "app/terminal/session.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/error.h"

namespace vitrel {

Session::Session(bool quiet, double wall_time, StopDeadline deadline)
    : display_(ProgressDisplay::mode(quiet)) {
  catch_stop_signals(wall_time, deadline);
  control_.should_stop = stop_requested;
  control_.on_progress = [this](const Progress& progress) { display_.show(progress); };
  say_ = [this](const std::string& line) {
    display_.say(line);
    display_.begin(line.substr(0, line.find(' ')));
  };
}

double Session::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void print_text(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw FileError(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
}

}  // namespace vitrel
