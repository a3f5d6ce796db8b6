#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/state/stage.h"

namespace vitrel {

/// The speed of work over the last quarter to half of its time. The time left thus grows if the work slows down.
class Pace {
 public:
  struct Mark {
    double seconds = 0;  ///< since a fixed start
    Progress progress = {};
  };

  explicit Pace(const Mark& start) : from_(start), next_(start) {}

  void note(const Mark& now);
  double elapsed() const { return now_.seconds - from_.seconds; }
  /// The increase of the value per second.
  double rate() const { return (now_.progress.value - from_.progress.value) / elapsed(); }
  /// The seconds until all is done; no value if the work does not advance.
  std::optional<double> left() const;

 private:
  Mark from_;  // start of the interval over which the rate is measured
  Mark next_;  // the next start, which replaces from_
  Mark now_;
};

/// Shows the progress of work with its rate and the time left on standard error: a single line that is rewritten on a
/// terminal, or a line every ten seconds elsewhere.
class ProgressDisplay {
 public:
  enum class Mode { silent, lines, terminal };
  /// The mode for standard error: `terminal`, or `lines` if it is no terminal.
  static Mode mode(bool quiet);

  explicit ProgressDisplay(Mode mode) : mode_(mode) {}
  ~ProgressDisplay() { clear(); }

  /// Sets the label of the progress that follows, such as "swell".
  void begin(const std::string& label);
  void show(const Progress& progress);
  /// Prints a line of its own, unless the mode is silent.
  void say(const std::string& line);
  /// Clears the line of progress on a terminal, so that other text can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  Mode mode_;
  std::string label_;
  std::optional<Pace> pace_;
  Clock::time_point started_{};
  double shown_ = 0;  // time of the last line, in seconds after the start
  bool line_is_open_ = false;
};

/// "dd:hh:mm:ss" without leading zero parts: "0:07", "3:05:00".
std::string duration_text(double seconds);

}  // namespace vitrel
