#pragma once

#include <cstdint>
#include <vector>

#include "core/neighbors/cell_grid.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "mc/sweep_state.h"

namespace vitrel::bench {

/// The sampler's Markov chain done the plain way, as its baseline: one trial after another among all
/// particles, every trial with a stream of its own, and everybody whose circumcircle is met decided
/// alone (support_gap.h). No domains, no SIMD batches, one thread.
class SequentialSampler {
 public:
  /// As for Sampler (mc/sampler.h).
  SequentialSampler(Configuration2& configuration, std::uint64_t seed);

  /// N trials.
  void sweep();
  void set_steps(double translation, double rotation);
  const TrialCounts& counts() const { return counts_; }
  /// Pairs decided since construction.
  std::uint64_t decisions() const { return decisions_; }

 private:
  void translate(std::size_t i, Stream& draw);
  void rotate(std::size_t i, Stream& draw);
  bool clear_of_others(std::size_t i, const Vec2& position, const Vec2& axis);

  Configuration2& configuration_;
  CellGrid<2> cells_;
  std::vector<Vec2> axis_;
  double largest_, margin_;
  double translation_ = 0.1, rotation_ = 0.1;
  std::uint64_t seed_, sweep_ = 0, decisions_ = 0;
  TrialCounts counts_;
};

}  // namespace vitrel::bench
