#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "app/terminal/progress.h"
#include "app/terminal/stop_signals.h"
#include "core/state/stage.h"

namespace vitrel {

/// What a command at work has: a run control that stops with a stop signal or the wall time, and a
/// display.
class Session {
 public:
  /// `wall_time` in seconds; 0: no limit.
  explicit Session(bool quiet, double wall_time = 0, StopDeadline deadline = StopDeadline::soon);

  const RunControl& control() const { return control_; }
  /// Begins a step: prints a line, and the label of the progress that follows.
  const std::function<void(const std::string&)>& say() const { return say_; }
  /// The label of the progress that follows.
  void begin(const std::string& label) { display_.begin(label); }
  /// Prints a line; the progress goes on.
  void note(const std::string& line) { display_.say(line); }
  /// Takes the progress off the terminal, before a summary is printed.
  void clear() { display_.clear(); }
  double seconds() const;

 private:
  ProgressDisplay display_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  RunControl control_;
  std::function<void(const std::string&)> say_;
};

/// To standard output, at once; throws FileError if it cannot be written. Nothing else writes there.
void print_text(std::string_view text);

}  // namespace vitrel
