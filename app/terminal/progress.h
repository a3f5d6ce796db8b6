#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/state/stage.h"

namespace vitrel {

/// How fast work advances, over the last quarter to half of its time: of work that slows down, more and more is left.
class Pace {
 public:
  struct Mark {
    double seconds = 0;  ///< since some start
    Progress progress = {};
  };

  explicit Pace(const Mark& start) : from_(start), next_(start) {}

  void note(const Mark& now);
  double elapsed() const { return now_.seconds - from_.seconds; }
  /// By how much the value rises per second.
  double rate() const { return (now_.progress.value - from_.progress.value) / elapsed(); }
  /// Seconds until all is done; nothing if the work does not advance.
  std::optional<double> left() const;

 private:
  Mark from_;  // the rate is that since then
  Mark next_;  // takes its place
  Mark now_;
};

/// Shows how far a piece of work has come, with rate and time left, on standard error: one line
/// that is rewritten on a terminal, a plain line every ten seconds elsewhere.
class ProgressDisplay {
 public:
  enum class Mode { silent, lines, terminal };
  /// `lines` or `terminal` by what standard error is.
  static Mode mode(bool quiet);

  explicit ProgressDisplay(Mode mode) : mode_(mode) {}
  ~ProgressDisplay() { clear(); }

  /// What the following progress is about ("swell").
  void begin(const std::string& label);
  void show(const Progress& progress);
  /// A line of its own, unless silent.
  void say(const std::string& line);
  /// Leaves an empty line on a terminal, for what is printed next.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  Mode mode_;
  std::string label_;
  std::optional<Pace> pace_;
  Clock::time_point started_{};
  double shown_ = 0;  // seconds after the start
  bool line_is_open_ = false;
};

/// "dd:hh:mm:ss" without leading zero parts: "0:07", "3:05:00".
std::string duration_text(double seconds);

}  // namespace vitrel
