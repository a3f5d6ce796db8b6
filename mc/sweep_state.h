#pragma once

#include <algorithm>
#include <cstdint>

namespace vitrel {

/// Counts of exchanges of places (exchanges.h).
struct ExchangeCounts {
  std::uint64_t tried = 0, accepted = 0;        ///< exchanges of two particles of different shapes
  std::uint64_t steps = 0, accepted_steps = 0;  ///< steps of collective exchanges

  void add(const ExchangeCounts& other) {
    tried += other.tried;
    accepted += other.accepted;
    steps += other.steps;
    accepted_steps += other.accepted_steps;
  }
};

struct TrialCounts {
  std::uint64_t translations_tried = 0, translations_accepted = 0;
  std::uint64_t rotations_tried = 0, rotations_accepted = 0;
  ExchangeCounts exchanges;

  std::uint64_t tried() const { return translations_tried + rotations_tried + exchanges.tried; }
  void add(const TrialCounts& other) {
    translations_tried += other.translations_tried;
    translations_accepted += other.translations_accepted;
    rotations_tried += other.rotations_tried;
    rotations_accepted += other.rotations_accepted;
    exchanges.add(other.exchanges);
  }
};

/// Counts of overlap tests.
struct OverlapTestCounts {
  std::uint64_t batches = 0;       ///< batches of up to `simd_width` ellipses
  std::uint64_t scalar_pairs = 0;  ///< pairs decided one by one

  void add(const OverlapTestCounts& other) {
    batches += other.batches;
    scalar_pairs += other.scalar_pairs;
  }
};

/// A trial step size, adapted to the acceptance.
struct StepSize {
  double size;
  std::uint64_t tried = 0, accepted = 0;  ///< since the last adaptation

  void count(std::uint64_t more_tried, std::uint64_t more_accepted) {
    tried += more_tried;
    accepted += more_accepted;
  }

  /// Adapts the size towards an acceptance of 0.35; waits for more trials if there are fewer than `enough`.
  void tune(std::uint64_t enough, double largest) {
    constexpr double target = 0.35, max_change = 2;
    if (tried < enough) return;
    const double acceptance = static_cast<double>(accepted) / static_cast<double>(tried);
    size = std::min(largest, size * std::clamp(acceptance / target, 1 / max_change, max_change));
    tried = accepted = 0;
  }
};

/// The state of a stage of sweeps, which together with the configuration suffices to continue with bit-identical
/// results.
struct SweepState {
  std::uint64_t next_sweep = 0;  ///< number of the next sweep, which selects its random stream
  std::uint64_t sweeps = 0;      ///< number of completed sweeps
  StepSize translation{0}, rotation{0.1};  ///< translation 0: a tenth of the typical length
  TrialCounts counts = {};
};

/// Sweeps between two adaptations of the step sizes.
inline constexpr std::uint64_t sweeps_per_tuning = 20;

/// The state of the box trials.
struct BoxState {
  StepSize step{0.01};  ///< step of ln V
  /// L_y/L_x and L_z/L_x at the start; 0 means those of the given configuration.
  double aspect_at_start = 0, depth_at_start = 0;
  std::uint64_t tried = 0, accepted = 0;  ///< since the start
};

}  // namespace vitrel
