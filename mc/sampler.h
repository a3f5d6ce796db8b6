#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "mc/checkerboard.h"
#include "mc/simd_cells.h"
#include "mc/sweep_state.h"
#include "mc/trial.h"

namespace vitrel {

/// Monte Carlo of hard ellipses at constant N, box and temperature, on any number of threads.
///
/// A trial picks a particle and, if it is not round, translation or rotation with equal chance; the
/// displacement is uniform in a square of half side `translation`, the turn uniform within ±
/// `rotation`. It is accepted if the particle then keeps the hard margin (disjoint.h) to all others.
///
/// In mixtures, a share of the trials instead picks two particles, which exchange places and angles if both
/// have room there. Where sizes are spread this relaxes dense liquids many orders of magnitude sooner.
///
/// One sweep is N trials:
///   1. The borders between domains (checkerboard.h) are shifted at random, and all particles sorted
///      into cells anew, in the order of their numbers.
///   2. The colours take turns, in random order. In the turn of its colour a domain of n particles has n
///      trials, each with one of these at random (an exchange: with two). A move of the centre into
///      another domain is rejected.
/// Domains of one colour share no particle and see none of each other's, so they can have their turns
/// at the same time. Sweep s draws from the stream (seed, trial_moves, s, 0), its domain k from (seed,
/// trial_moves, s, k + 1): the state is the same, bit by bit, for any number of threads, and a sampler
/// that begins at sweep s goes on as one that has come there.
///
/// Why every hard state is as likely as any other, for fixed step sizes. Given borders and colours, all
/// that a trial depends on stays as it is while a domain has its turn: which particles it has, how many,
/// and all outside. Among these states a trial and its reverse are proposed with the same probability (to
/// 1e-14: the pick of one of n by a number of 53 bits), and accepted or not by the hard states
/// scalar_pairs; so each trial is in detailed balance with the uniform distribution, and so is, the order being
/// random, the sweep. Borders and order are drawn without regard to the state. There is no other
/// rejection: cells have no largest number of particles. Every border moves, so that no two states are
/// cut off from each other by it. Accepted is decided by proofs (overlap_look.h) whose answer depends
/// on the state only, to the rounding of the margin.
///
/// Step sizes change only in `tune`, which belongs to equilibration.
/// Sources: metropolis1953; for the checkerboard anderson2013, for exchanges berthier2016.
class Sampler {
 public:
  /// The configuration must be hard, with wrapped positions, and outlive the sampler; nobody else
  /// may move particles meanwhile, nor change shapes but to smaller ones.
  Sampler(Configuration2& configuration, std::uint64_t seed, const SweepState& state = {},
          int threads = 1);

  void sweep();

  /// Adapts both step sizes towards an acceptance of 0.35, by the trials since the last adaptation;
  /// waits for more if they are too few to tell.
  void tune();

  /// Gives particle i another shape where it is, if it then keeps twice the hard margin to all
  /// others (twice, so that scaling all lengths afterwards cannot cost it the margin by rounding).
  bool reshape(std::size_t i, const Ellipse& shape);

  /// Scales the sides of the box and all positions by these factors, if all particles then keep the
  /// margin to each other; shapes and angles stay.
  bool rescale(const Vec2& factors);

  void set_steps(double translation, double rotation);
  /// The share of trials, 0 at first, that instead let two particles exchange their places and angles:
  /// of any shapes, or nothing happens.
  void set_exchanges(double share) { exchanges_ = share; }
  /// As given at construction, and what has been done since.
  const SweepState& state() const { return state_; }
  const TrialCounts& counts() const { return state_.counts; }

  /// What the decisions took since construction.
  const OverlapTestCounts& overlap_tests() const { return overlap_tests_; }

 private:
  struct Tally {
    TrialCounts counts;
    OverlapTestCounts overlap_tests;
  };
  struct DomainContext;
  using Words = Stream::Block;  // one trial's

  void fit_box();
  void fit_board();
  bool is_hard();
  void arrange();
  void fill_domain(std::size_t domain);
  void sweep_domains(const std::vector<std::size_t>& domains);
  void sweep_domain(std::size_t domain, Tally& tally);
  void translate(std::size_t i, const Words& words, DomainContext& context);
  void rotate(std::size_t i, const Words& words, DomainContext& context);
  void exchange(std::size_t i, std::size_t j, DomainContext& context);
  bool is_exchange(std::uint64_t word) const {
    return static_cast<double>(word >> 11) * 0x1p-53 < exchanges_;
  }
  bool fits(std::size_t i, OverlapTestCounts& tests) const;
  bool clear_of_others(std::size_t i, const OverlapBatch& batch, const Vec2& position,
                       const Checkerboard::Cell& cell, OverlapTestCounts& tests) const;
  bool clear_of_itself(const Ellipse& shape, const Vec2& axis, double margin) const;
  void add(const Tally& tally);

  Configuration2& configuration_;
  double largest_, margin_;
  Vec2 half_box_;
  double shortest_side_;
  int threads_;
  std::vector<Vec2> axis_;  // unit major axes
  std::optional<Checkerboard> board_;
  SimdCells cells_;
  std::vector<SimdCells::Index> order_;          // particles, domain by domain and cell by cell
  std::vector<SimdCells::Index> cell_of_;        // of every particle, while sorting
  std::vector<SimdCells::Index> begin_;          // of every cell in order_, while sorting
  std::vector<std::size_t> domain_begin_;        // of every domain in order_
  std::vector<SimdCells::FreeList> free_lists_;  // of every domain
  double exchanges_ = 0;
  std::uint64_t seed_;
  SweepState state_;
  OverlapTestCounts overlap_tests_;
};

}  // namespace vitrel
