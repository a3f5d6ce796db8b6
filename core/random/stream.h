#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace vitrel {

/// The purpose of a random number: streams of different purposes are independent.
enum class Purpose : std::uint64_t {
  shapes = 1,
  placement = 2,
  velocities = 3,
  brownian_step = 4,
  trial_moves = 5,
  box_trials = 6,
  isotropic_axes = 7,
  kicks = 8,
  resampling = 9,
  benchmark_cases = 90,
  tests = 100,
};

/// A stream of random numbers keyed by (seed, purpose, step, particle): Philox 4×64-10 (Salmon et al., 2011) with the
/// key (seed, purpose) and the counter (draw, step, particle). Equal keys give equal numbers, independent of all
/// other draws and of the number of threads.
class Stream {
 public:
  /// The four words that one evaluation of the generator gives.
  using Block = std::array<std::uint64_t, 4>;

  Stream(std::uint64_t seed, Purpose purpose, std::uint64_t step = 0, std::uint64_t particle = 0);

  std::uint64_t bits();
  /// Fills `blocks` with the words that four calls of bits() per block would give. What is left of a block already
  /// begun is skipped.
  void fill(std::span<Block> blocks);
  /// A uniform number on [0, 1), in multiples of 2⁻⁵³.
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// A uniform number on 0 … n − 1 for n ≥ 1, without modulo bias.
  std::uint64_t below(std::uint64_t n);
  /// A standard normal number, by the method of Box and Muller.
  double normal();

 private:
  Block next_block();

  std::array<std::uint64_t, 2> key_;
  Block counter_;
  Block words_{};
  int used_ = 4;
  double spare_normal_ = 0;
  bool has_spare_ = false;
};

}  // namespace vitrel
