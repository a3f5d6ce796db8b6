#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "mc/exchanges.h"
#include "mc/hard_particles.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// Metropolis Monte Carlo of hard ellipses or ellipsoids at constant N, box and temperature, on any number of threads.
///
/// A trial picks a particle and, if it is not round, translation or rotation with equal probability. The displacement
/// is uniform in a square (cube) of half side `translation`, the rotation uniform within ± `rotation`. In space an
/// ellipsoid rotates by a vector, uniform in a cube about its own axes, a spheroid by one normal to its axis. The trial
/// is accepted if the particle then keeps the hard-core margin (hard_core.h) to all others.
///
/// In mixtures, a share of the trials instead are exchanges of places (exchanges.h). A sweep can end with collective ones.
///
/// One sweep is N trials:
///   1. The borders between domains (checkerboard.h) are shifted at random, and all particles are sorted into cells,
///      in the order of their numbers.
///   2. The colours follow each other in random order. Each domain of the current colour, with n particles, makes n
///      trials, each with one of these at random (an exchange: with two). A move of the centre into another domain
///      is rejected.
///   3. Collective exchanges of all particles, on one thread.
/// Domains of one colour share no particles and do not interact, so they are swept in parallel. Sweep s draws from the
/// stream (seed, trial_moves, s, 0), its domain k from (seed, trial_moves, s, k + 1): the state is bit-identical for any
/// number of threads, and a sampler started at sweep s continues like one that has reached it.
///
/// Uniform sampling of all hard states, for fixed step sizes. Given borders and colours, everything that a trial
/// depends on is constant while a domain is swept: which particles it holds, how many, and all others. A trial and its
/// reverse are proposed with the same probability (to 1e-14: one of n is picked by a number of 53 bits), and accepted
/// according to the hard states alone. (In space a rotation is undone by the opposite one about the same axes of the
/// body.) So each trial satisfies detailed balance with respect to the uniform distribution, and so does the sweep, since
/// its order is random. Borders and order are drawn independently of the state. Nothing else is rejected. All borders
/// move, so they do not cut off states from each other.
///
/// Step sizes change only in `tune`, which belongs to equilibration.
/// Sources: metropolis1953; for the checkerboard anderson2013.
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

  /// HardParticles::try_reshape and try_rescale.
  bool reshape(std::size_t i, const ParticleShape<Dim>& shape) {
    return particles_.try_reshape(i, shape, overlap_tests_);
  }
  bool rescale(const Vec<Dim>& factors) {
    return particles_.try_rescale(factors, threads_, overlap_tests_);
  }

  void set_steps(double translation, double rotation);
  /// Exchanges of places; initially none. Shapes must then stay as they are.
  void set_exchanges(const ExchangeOptions& options);
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
  using Words = Stream::Block;  // random words of one trial

  void sweep_domains(const std::vector<std::size_t>& domains);
  void sweep_domain(std::size_t domain, Tally& tally);
  void translate(std::size_t i, const Words& words, std::size_t domain, Tally& tally);
  void rotate(std::size_t i, const Words& words, Tally& tally);
  double exchange_share() const { return exchanges_ ? exchanges_->options().trials : 0; }
  Vec<Dim> step(const Words& words) const;
  void add(const Tally& tally);

  HardParticles<Dim> particles_;
  std::optional<Exchanges<Dim>> exchanges_;
  int threads_;
  std::uint64_t seed_;
  SweepState state_;
  OverlapTestCounts overlap_tests_;
};

}  // namespace vitrel
