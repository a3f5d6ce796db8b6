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

/// Metropolis Monte Carlo of hard ellipses or ellipsoids at constant N, box and temperature, on any number of threads.
///
/// A trial picks a particle and, if it is not round, translation or rotation with equal probability. The displacement
/// is uniform in a square (cube) of half side `translation`, the rotation uniform within ± `rotation`. In space an
/// ellipsoid rotates by a vector, uniform in a cube about its own axes, a spheroid by one normal to its axis. The trial
/// is accepted if the particle then keeps the hard-core margin (hard_core.h) to all others.
///
/// In mixtures, a share of the trials instead picks two particles, which exchange positions and angles if both then
/// fit. In polydisperse systems this relaxes dense liquids many orders of magnitude faster.
///
/// One sweep is N trials:
///   1. The borders between domains (checkerboard.h) are shifted at random, and all particles are sorted into cells,
///      in the order of their numbers.
///   2. The colours follow each other in random order. Each domain of the current colour, with n particles, makes n
///      trials, each with one of these at random (an exchange: with two). A move of the centre into another domain
///      is rejected.
/// Domains of one colour share no particles and do not interact, so they are swept in parallel. Sweep s draws from the
/// stream (seed, trial_moves, s, 0), its domain k from (seed, trial_moves, s, k + 1): the state is bit-identical for any
/// number of threads, and a sampler started at sweep s continues like one that has reached it.
///
/// Uniform sampling of all hard states, for fixed step sizes. Given borders and colours, everything that a trial
/// depends on is constant while a domain is swept: which particles it holds, how many, and all others. A trial and its
/// reverse are proposed with the same probability (to 1e-14: one of n is picked by a number of 53 bits), and accepted
/// according to the hard states alone. (In space a rotation is undone by the opposite one about the same axes of the
/// body.) So each trial satisfies detailed balance with respect to the uniform distribution, and so does the sweep, since
/// its order is random. Borders and order are drawn independently of the state. Nothing else is rejected: cells have no
/// capacity limit. All borders move, so they do not cut off states from each other. Acceptance is decided by proofs
/// (ellipse_overlap_batch.h, ellipsoid_overlap_batch.h) that depend on the state only, to the rounding of the margin.
///
/// Step sizes change only in `tune`, which belongs to equilibration.
/// Sources: metropolis1953; for the checkerboard anderson2013, for exchanges berthier2016.
template <int Dim>
class Sampler {
 public:
  /// The configuration must be hard, with wrapped positions, and outlive the sampler. Meanwhile nothing else may move
  /// particles, or change shapes except to smaller ones.
  Sampler(Configuration<Dim>& configuration, std::uint64_t seed, const SweepState& state = {},
          int threads = 1);

  void sweep();

  /// Adapts both step sizes towards an acceptance of 0.35, by the trials since the last adaptation; waits for more
  /// if these are too few.
  void tune();

  /// Replaces the shape of particle i if it then keeps twice the hard-core margin to all others (twice, so that a
  /// later scaling of all lengths keeps the margin in spite of rounding).
  bool reshape(std::size_t i, const Solid<Dim>& shape);

  /// Scales the sides of the box and all positions by these factors, if all particles then keep the
  /// margin to each other; shapes and angles stay.
  bool rescale(const Vec<Dim>& factors);

  void set_steps(double translation, double rotation);
  /// The share of trials, initially 0, that instead exchange the positions and angles of two particles of different
  /// shapes.
  void set_exchanges(double share) { exchanges_ = share; }
  /// The state given at construction, advanced by the work since.
  const SweepState& state() const { return state_; }
  const TrialCounts& counts() const { return state_.counts; }

  /// Overlap tests since construction.
  const OverlapTestCounts& overlap_tests() const { return overlap_tests_; }

 private:
  struct Tally {
    TrialCounts counts;
    OverlapTestCounts overlap_tests;
  };
  struct DomainContext;
  using Words = Stream::Block;  // random words of one trial
  using Body = OrientedBody<Dim>;
  using Cells = SimdCells<Dim>;
  using Cell = typename Checkerboard<Dim>::Cell;

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
  Vec<Dim> step(const Words& words) const;
  void swap_places(std::size_t i, std::size_t j);
  decltype(auto) body_of(std::size_t i) const;
  bool fits(std::size_t i, OverlapTestCounts& tests) const;
  bool is_clear(std::size_t i, const Body& body, const Vec<Dim>& position, double margin,
                OverlapTestCounts& tests) const;
  bool clear_of_itself(const Body& body, double margin) const;
  void add(const Tally& tally);

  Configuration<Dim>& configuration_;
  double largest_, margin_;
  Vec<Dim> half_box_;
  double shortest_side_;
  int threads_;
  std::vector<Body> bodies_;
  std::optional<Checkerboard<Dim>> board_;
  Cells cells_;
  std::vector<typename Cells::Index> order_;    // particles, domain by domain and cell by cell
  std::vector<typename Cells::Index> cell_of_;  // of every particle, while sorting
  std::vector<typename Cells::Index> begin_;    // of every cell in order_, while sorting
  std::vector<std::size_t> domain_begin_;       // of every domain in order_
  std::vector<typename Cells::FreeList> free_lists_;  // of every domain
  double exchanges_ = 0;
  std::uint64_t seed_;
  SweepState state_;
  OverlapTestCounts overlap_tests_;
};

}  // namespace vitrel
