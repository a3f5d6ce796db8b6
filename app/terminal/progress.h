#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "core/state/stage.h"

namespace vitrel {

/// Shows how far a piece of work has come, with rate and time left, on standard error: one line
/// that is rewritten on a terminal, now and then a plain line elsewhere.
class ProgressDisplay {
 public:
  enum class Mode { silent, lines, terminal };
  /// `lines` or `terminal` by what standard error is.
  static Mode mode(bool quiet);

  /// `prefix` stands before every label ("job 3 of 18: ").
  explicit ProgressDisplay(Mode mode, std::string prefix = "")
      : mode_(mode), prefix_(std::move(prefix)) {}
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
  std::string prefix_, label_;
  std::optional<Progress> first_;
  Clock::time_point started_{}, shown_{};
  bool line_is_open_ = false;
};

/// "dd:hh:mm:ss" without leading zero parts: "0:07", "3:05:00".
std::string duration_text(double seconds);

}  // namespace vitrel
