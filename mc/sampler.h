#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "core/state/typical_scales.h"
#include "mc/exchanges.h"
#include "mc/hard_particles.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// Metropolis Monte Carlo of hard bodies at constant N, box and temperature, on any number of threads.
///
/// A trial picks a particle and, if it is not round, translation or rotation with equal probability. The displacement
/// is uniform in a square (cube) of half side `translation`, and the rotation uniform within ± `rotation`. In space an
/// ellipsoid rotates by a vector that is uniform in a cube about its own axes, and a spheroid by one normal to its
/// axis. The trial is accepted if the particle then keeps the hard-core margin (hard_core.h) to all others.
///
/// In mixtures, a share of the trials are exchanges of places instead (exchanges.h), and a sweep can end with
/// collective exchanges.
///
/// One sweep is N trials:
///   1. The borders between domains (checkerboard.h) are shifted at random, and all particles are sorted into cells,
///      in the order of their numbers.
///   2. The colours follow each other in random order. Each domain of the current colour, with n particles, makes n
///      trials, each with one of its particles at random (an exchange has two). A move of the centre into another
///      domain is rejected.
///   3. Collective exchanges of all particles are made on one thread.
/// Domains of one colour share no particles and do not interact, so they are swept in parallel. Sweep s draws from the
/// stream (seed, trial_moves, s, 0), and its domain k from (seed, trial_moves, s, k + 1). The state is therefore
/// bit-identical for any number of threads, and a sampler started at sweep s continues like one that has reached it.
///
/// For fixed step sizes all hard states are sampled uniformly, for the following reason. Given borders and colours,
/// everything that a trial depends on is constant while a domain is swept: which particles the domain holds, how many,
/// and all other particles. A trial and its reverse are proposed with the same probability (to 1e-14, since one of n is
/// picked by a number of 53 bits), and accepted according to the hard states alone. (In space a rotation is undone by
/// the opposite one about the same axes of the body.) So each trial satisfies detailed balance with respect to the
/// uniform distribution, and so does the sweep, since its order is random. Borders and order are drawn independently of
/// the state. Nothing else is rejected. All borders move, so they do not separate states from each other for good.
///
/// Step sizes change only in `tune`, which belongs to equilibration.
/// Sources: metropolis1953, and anderson2013 for the checkerboard.
template <class Shape>
class Sampler {
 public:
  static constexpr int Dim = Shape::dimension;
  /// The configuration must be hard, with wrapped positions, and outlive the sampler. As long as the sampler is used,
  /// nothing else may move particles, or change shapes except to smaller ones.
  Sampler(Configuration<Dim>& configuration, std::uint64_t seed, const SweepState& state = {},
          int threads = 1);

  void sweep();

  /// Adapts both step sizes towards an acceptance of 0.35, using the trials since the last adaptation; waits for more
  /// if these are too few.
  void tune();

  /// These functions call HardParticles::try_reshape and try_rescale.
  bool reshape(std::size_t i, const ParticleShape<Dim>& shape) {
    return particles_.try_reshape(i, shape, overlap_tests_);
  }
  bool rescale(const Vec<Dim>& factors) {
    return particles_.try_rescale(factors, threads_, overlap_tests_);
  }

  void set_steps(double translation, double rotation);
  /// Sets the exchanges of places; initially there are none. From then on shapes must stay as they are.
  void set_exchanges(const ExchangeOptions& options);
  /// Returns the state given at construction, advanced by the work since.
  const SweepState& state() const { return state_; }
  const TrialCounts& counts() const { return state_.counts; }

  /// Returns the counts of overlap tests since construction.
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

  HardParticles<Shape> particles_;
  std::optional<Exchanges<Shape>> exchanges_;
  int threads_;
  std::uint64_t seed_;
  SweepState state_;
  OverlapTestCounts overlap_tests_;
};

template <int Dim>
Sampler(Configuration<Dim>&, std::uint64_t, const SweepState& = {}, int = 1)
    -> Sampler<ParticleShape<Dim>>;

template <class Shape>
Sampler<Shape>::Sampler(Configuration<Dim>& configuration, std::uint64_t seed,
                        const SweepState& state, int threads)
    : particles_(configuration), threads_(threads), seed_(seed), state_(state) {
  constexpr double first_step = 0.1;
  if (state_.translation.size == 0)
    state_.translation.size = first_step * typical_length(configuration);
}

template <class Shape>
void Sampler<Shape>::set_steps(double translation, double rotation) {
  state_.translation.size = translation;
  state_.rotation.size = rotation;
}

template <class Shape>
void Sampler<Shape>::set_exchanges(const ExchangeOptions& options) {
  if (options.any())
    exchanges_.emplace(particles_, options);
  else
    exchanges_.reset();
}

template <class Shape>
void Sampler<Shape>::sweep() {
  Stream draw(seed_, Purpose::trial_moves, state_.next_sweep, 0);
  particles_.board().shift(draw);
  particles_.arrange_by_domain(threads_);
  if (exchange_share() > 0) exchanges_->rank_domains();
  const auto colours = particles_.board().colours();
  std::vector<std::size_t> order(colours.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[draw.below(k)]);
  for (const std::size_t colour : order) sweep_domains(colours[colour]);
  if (exchanges_) exchanges_->run_chain(draw, state_.counts.exchanges, overlap_tests_);
  ++state_.next_sweep;
  ++state_.sweeps;
}

template <class Shape>
void Sampler<Shape>::sweep_domains(const std::vector<std::size_t>& domains) {
  std::mutex adding;
  in_parallel(domains.size(), threads_, [&](std::size_t begin, std::size_t end) {
    Tally mine;
    for (std::size_t k = begin; k < end; ++k) sweep_domain(domains[k], mine);
    const std::lock_guard lock(adding);
    add(mine);
  });
}

template <class Shape>
void Sampler<Shape>::sweep_domain(std::size_t domain, Tally& tally) {
  const auto members = particles_.members(domain);
  const double exchange_share = this->exchange_share();
  const auto ranked = exchange_share > 0 ? exchanges_->ranked_members(domain) : members;
  const auto& shapes = particles_.configuration().shape;
  Stream draw(seed_, Purpose::trial_moves, state_.next_sweep, domain + 1);
  // Several blocks are drawn at a time, so that independent evaluations of the generator overlap.
  std::array<Words, 16> drawn;
  for (std::size_t done = 0; done < members.size(); done += drawn.size()) {
    const std::span trials(drawn.data(), std::min(drawn.size(), members.size() - done));
    draw.fill(trials);
    for (const Words& words : trials) {
      if (static_cast<double>(words[3] >> 11) * 0x1p-53 < exchange_share) {
        exchanges_->try_two(ranked, words, tally.counts.exchanges, tally.overlap_tests);
        continue;
      }
      const std::size_t i = members[pick(words[0], members.size())];
      if (!shapes[i].is_round() && (words[3] & 1) == 1)
        rotate(i, words, tally);
      else
        translate(i, words, domain, tally);
    }
  }
}

/// Returns the direction and share of a translation or rotation; each component is between −1 and 1, symmetric about 0.
template <class Shape>
auto Sampler<Shape>::step(const Words& words) const -> Vec<Dim> {
  if constexpr (Dim == 2)
    return {plus_minus_one(words[1]), plus_minus_one(words[2])};
  else
    return {plus_minus_one(words[1]), plus_minus_one(words[2]),
            share_above(words[3], exchange_share())};
}

template <class Shape>
VITREL_FLATTEN void Sampler<Shape>::translate(std::size_t i, const Words& words, std::size_t domain,
                                              Tally& tally) {
  const auto& group = particles_.cells().group_of(i);
  Vec<Dim> position =
      group.position(particles_.cells().lane_of(i)) + state_.translation.size * step(words);
  Shift<Dim> crossed = Shift<Dim>::Zero();
  if ((position.array().abs() >= particles_.half_box().array()).any())
    particles_.configuration().box.wrap(position, crossed);
  ++tally.counts.translations_tried;
  const auto& board = particles_.board();
  const auto cell = board.cell_of(position);
  if (board.domain_of(cell) != domain) return;
  if (!particles_.is_clear_at(i, position, cell, tally.overlap_tests)) return;
  ++tally.counts.translations_accepted;
  particles_.move(i, position, crossed, board.index(cell), particles_.free_list(domain));
}

template <class Shape>
void Sampler<Shape>::rotate(std::size_t i, const Words& words, Tally& tally) {
  ++tally.counts.rotations_tried;
  tally.counts.rotations_accepted +=
      particles_.try_turn(i, state_.rotation.size * step(words), tally.overlap_tests);
}

template <class Shape>
void Sampler<Shape>::add(const Tally& tally) {
  const TrialCounts& more = tally.counts;
  state_.counts.add(more);
  state_.translation.count(more.translations_tried, more.translations_accepted);
  state_.rotation.count(more.rotations_tried, more.rotations_accepted);
  overlap_tests_.add(tally.overlap_tests);
}

template <class Shape>
void Sampler<Shape>::tune() {
  constexpr std::uint64_t enough = 100;  // measures the acceptance to about 0.05
  state_.translation.tune(enough, particles_.half_box().minCoeff());
  state_.rotation.tune(enough, std::numbers::pi / 2);
}

extern template class Sampler<ParticleShape<2>>;
extern template class Sampler<ParticleShape<3>>;

}  // namespace vitrel
