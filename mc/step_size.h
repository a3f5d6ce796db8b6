#pragma once

#include <algorithm>
#include <cstdint>

namespace vitrel {

/// The size of a kind of trial steps, adapted by how many of them were accepted.
class StepSize {
 public:
  explicit StepSize(double size) : size_(size) {}

  double size() const { return size_; }
  void set(double size) { size_ = size; }

  /// Towards an acceptance of 0.35, by the trials since the last adaptation; waits for more if they
  /// are fewer than `enough`. `tried` and `accepted` count all trials so far.
  void tune(std::uint64_t tried, std::uint64_t accepted, std::uint64_t enough, double largest) {
    constexpr double wanted = 0.35, strongest = 2;
    if (tried - tried_ < enough) return;
    const double acceptance =
        static_cast<double>(accepted - accepted_) / static_cast<double>(tried - tried_);
    size_ = std::min(largest, size_ * std::clamp(acceptance / wanted, 1 / strongest, strongest));
    tried_ = tried;
    accepted_ = accepted;
  }

 private:
  double size_;
  std::uint64_t tried_ = 0, accepted_ = 0;  // at the last adaptation
};

}  // namespace vitrel
