#pragma once

#include <chrono>

namespace vitrel {

/// Wall time spent on a piece of work, by this process and those before it.
class WorkTimer {
 public:
  /// `before`: seconds that other processes spent.
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
