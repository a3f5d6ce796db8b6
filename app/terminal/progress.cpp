#include "app/terminal/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "app/terminal/style.h"

namespace vitrel {
namespace {

std::string left_text(const std::optional<double>& seconds) {
  return seconds ? ", " + duration_text(*seconds) + " left" : "";
}

}  // namespace

void Pace::note(const Mark& now) {
  constexpr double share = 0.25;
  now_ = now;
  if (now.seconds - next_.seconds < share * now.seconds) return;
  from_ = next_;
  next_ = now;
}

std::optional<double> Pace::left() const {
  const double advance = now_.progress.fraction - from_.progress.fraction;
  if (!(advance > 0)) return std::nullopt;
  return elapsed() * (1 - now_.progress.fraction) / advance;
}

ProgressDisplay::Mode ProgressDisplay::mode(bool quiet) {
  if (quiet) return Mode::silent;
  return is_terminal(STDERR_FILENO) ? Mode::terminal : Mode::lines;
}

void ProgressDisplay::begin(const std::string& label) {
  clear();
  label_ = label;
  pace_.reset();
}

void ProgressDisplay::show(const Progress& progress) {
  if (mode_ == Mode::silent) return;
  const Clock::time_point now = Clock::now();
  if (!pace_) {
    // Rates count from this moment, because a continued run has done its first part long ago.
    pace_.emplace(Pace::Mark{0, progress});
    started_ = now;
    shown_ = 0;
    return;
  }
  const double seconds = std::chrono::duration<double>(now - started_).count();
  if (seconds - shown_ < (mode_ == Mode::terminal ? 0.2 : 10)) return;
  shown_ = seconds;
  pace_->note({seconds, progress});
  const std::string line =
      fmt::format("{} {:.1f} %, {} {:.5g} ({:.3g}/s){}", label_, 100 * progress.fraction,
                  progress.quantity, progress.value, pace_->rate(), left_text(pace_->left()));
  if (mode_ == Mode::terminal) {
    // This returns to the start of the line, writes, and erases the rest of the previous line.
    fmt::print(stderr, "\r{}\033[K", line);
    static_cast<void>(std::fflush(stderr));
    line_is_open_ = true;
  } else {
    fmt::print(stderr, "{}\n", line);
  }
}

void ProgressDisplay::say(const std::string& line) {
  if (mode_ == Mode::silent) return;
  clear();
  fmt::print(stderr, "{}\n", visible(line));
}

void ProgressDisplay::clear() {
  if (line_is_open_) fmt::print(stderr, "\r\033[K");
  line_is_open_ = false;
}

std::string duration_text(double seconds) {
  if (!(seconds >= 0 && seconds < 1e9)) return "?";
  const auto total = static_cast<long>(std::lround(seconds));
  const long days = total / 86400, hours = total / 3600 % 24, minutes = total / 60 % 60;
  const long rest = total % 60;
  if (days > 0) return fmt::format("{}:{:02}:{:02}:{:02}", days, hours, minutes, rest);
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, rest);
  return fmt::format("{}:{:02}", minutes, rest);
}

}  // namespace vitrel
