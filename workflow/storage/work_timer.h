#pragma once

#include <chrono>

namespace vitrel {

/// Wall time that this process and earlier ones have spent on a piece of work.
class WorkTimer {
 public:
  /// `before` is the time that earlier processes spent, in seconds.
  explicit WorkTimer(double before = 0) : before_(before) {}

  double seconds() const {
    return before_ + std::chrono::duration<double>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;

  double before_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace vitrel
