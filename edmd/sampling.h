#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace vitrel {

/// The times of the samples of a run, in ascending order. The times of `linear_times` and `logarithmic_times` are
/// computed on demand, since there may be 10⁸ of them.
class SampleTimes {
 public:
  /// A run without samples.
  SampleTimes() = default;
  SampleTimes(std::vector<double> listed) : listed_(std::move(listed)), size_(listed_.size()) {}

  std::uint64_t size() const { return size_; }
  /// Returns the time of sample k < size().
  double operator[](std::uint64_t k) const;

 private:
  friend SampleTimes linear_times(double interval, double duration);
  friend SampleTimes logarithmic_times(double first, int per_decade, double duration);

  std::vector<double> listed_;
  double interval_ = 0;  ///< the first time after 0
  double duration_ = 0;
  int per_decade_ = 0;  ///< 0: evenly spaced
  std::uint64_t size_ = 0;
};

/// Returns the times 0, interval, 2 interval, … ≤ duration.
SampleTimes linear_times(double interval, double duration);

/// Returns the times 0, first, first · 10^(1/per_decade), … ≤ duration.
SampleTimes logarithmic_times(double first, int per_decade, double duration);

}  // namespace vitrel
