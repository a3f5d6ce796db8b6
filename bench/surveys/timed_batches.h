#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

#include "bench/surveys/engine_speed.h"

namespace vitrel::bench {

/// Measures the time per call of a function in batches. The batches grow as far as the limit of seconds allows, but
/// at least one call is made.
///
/// Every batch is run three times and its shortest time counts, so that interruptions do not. Calls that take more
/// than a millisecond are made once.
class TimedBatches {
 public:
  /// Seconds since a fixed time.
  using Clock = std::function<double()>;

  explicit TimedBatches(double seconds = std::numeric_limits<double>::infinity(),
                        Clock clock = processor_seconds)
      : clock_(std::move(clock)), seconds_left_(seconds) {}

  /// The number of calls to make next, out of the `left` remaining ones; 0 when the seconds are used up.
  std::size_t next(std::size_t left) const {
    if (calls_ == 0) return std::min<std::size_t>(left, 1);
    const double cost = seconds_ / static_cast<double>(calls_) * repeats();
    if (cost > seconds_left_) return 0;
    const double affordable = seconds_left_ / std::max(cost, 1e-9);
    const std::size_t size = std::min(left, last_ * 2);
    return affordable < static_cast<double>(size) ? static_cast<std::size_t>(affordable) : size;
  }

  /// Runs ask(), which makes `count` calls.
  template <class Ask>
  void run(std::size_t count, Ask&& ask) {
    double best = std::numeric_limits<double>::infinity();
    const int times = calls_ == 0 ? 1 : repeats();
    for (int k = 0; k < times; ++k) {
      const double start = clock_();
      ask();
      const double spent = clock_() - start;
      best = std::min(best, spent);
      seconds_left_ -= spent;
    }
    seconds_ += best;
    calls_ += count;
    last_ = count;
  }

  double ns_per_call() const { return 1e9 * seconds_ / static_cast<double>(calls_); }

 private:
  int repeats() const { return seconds_ < 1e-3 * static_cast<double>(calls_) ? 3 : 1; }

  Clock clock_;
  double seconds_left_;
  double seconds_ = 0;     // of the best runs
  std::size_t calls_ = 0;  // in these runs
  std::size_t last_ = 0;   // calls in the last batch
};

}  // namespace vitrel::bench
