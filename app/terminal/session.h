#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "app/terminal/progress.h"
#include "app/terminal/stop_signals.h"
#include "core/state/stage.h"

namespace vitrel {

/// The surroundings of a command at work: a run control that reacts to stop signals and to the limit of wall time,
/// and a display.
class Session {
 public:
  /// `wall_time` is in seconds; 0 means no limit.
  explicit Session(bool quiet, double wall_time = 0, StopDeadline deadline = StopDeadline::soon);

  const RunControl& control() const { return control_; }
  /// Begins a step: prints a line and makes it the label of the progress that follows.
  const std::function<void(const std::string&)>& say() const { return say_; }
  /// Sets the label of the progress that follows.
  void begin(const std::string& label) { display_.begin(label); }
  /// Prints a line while the progress continues.
  void note(const std::string& line) { display_.say(line); }
  /// Removes the progress from the terminal, so that a summary can be printed.
  void clear() { display_.clear(); }
  double seconds() const;

 private:
  ProgressDisplay display_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  RunControl control_;
  std::function<void(const std::string&)> say_;
};

/// Prints on standard output at once. Throws FileError if that fails. Nothing else writes there.
void print_text(std::string_view text);

}  // namespace vitrel
