#pragma once

#include <algorithm>
#include <cstdint>

#include "core/elementary.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "mc/options.h"
#include "mc/sampler.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// Monte Carlo of hard bodies at constant N, pressure and temperature (Wood, 1968).
///
/// One sweep is two box trials, each of which costs about half as much as a sweep of the Sampler, and one such sweep.
/// In a box trial ln V changes by a uniform amount within ± its step, and all positions scale; shapes and angles do not
/// change. If nothing overlaps, the trial is accepted with probability
///
///     min(1, exp(−βP (V' − V) + (N + 1) ln(V'/V))),
///
/// which is tested first because it is cheap. An anisotropic trial changes one of the sides, each with equal
/// probability; a liquid does not resist shear, so the ratio of any two sides stays within a factor `max_aspect_change`
/// of its initial value. Trial k of sweep s draws from the stream (seed, box_trials, s, k), so results do not depend on
/// the number of threads. Detailed balance holds for fixed step sizes, which change only in `tune`.
///
/// `pressure` is βP, in units of one over the unit of area (a b of the reference species) or of volume (a b c). Source:
/// wood1968.
template <class Shape>
class PressureSampler {
 public:
  static constexpr int Dim = Shape::dimension;
  static constexpr double max_aspect_change = 2;
  static constexpr std::uint64_t box_trials = 2;

  /// The configuration must satisfy the conditions of Sampler.
  PressureSampler(Configuration<Dim>& configuration, double pressure, BoxChange change,
                  std::uint64_t seed, const SweepState& moves = {}, const BoxState& box = {},
                  int threads = 1);

  void sweep();
  /// Adapts all step sizes towards an acceptance of 0.35 (Sampler::tune).
  void tune();

  void set_box_step(double step) { box_.step.size = step; }
  /// Returns the state given at construction, advanced by the work since.
  const SweepState& moves() const { return moves_.state(); }
  const BoxState& box() const { return box_; }

 private:
  void try_box(Stream draw);
  bool change_box(const Vec<Dim>& factors);

  Configuration<Dim>& configuration_;
  double pressure_;
  BoxChange change_;
  std::uint64_t seed_;
  BoxState box_;
  Sampler<Shape> moves_;
};

template <int Dim>
PressureSampler(Configuration<Dim>&, double, BoxChange, std::uint64_t, const SweepState& = {},
                const BoxState& = {}, int = 1) -> PressureSampler<ParticleShape<Dim>>;

namespace detail {

/// Returns the sides at the start of the run, divided by L_x.
template <int Dim>
Vec<Dim> proportions_at_start(const BoxState& box) {
  if constexpr (Dim == 2)
    return {1, box.aspect_at_start};
  else
    return {1, box.aspect_at_start, box.depth_at_start};
}

}  // namespace detail

template <class Shape>
PressureSampler<Shape>::PressureSampler(Configuration<Dim>& configuration, double pressure,
                                        BoxChange change, std::uint64_t seed,
                                        const SweepState& moves, const BoxState& box, int threads)
    : configuration_(configuration),
      pressure_(pressure),
      change_(change),
      seed_(seed),
      box_(box),
      moves_(configuration, seed, moves, threads) {
  if (box_.aspect_at_start != 0) return;
  const Vec<Dim>& lengths = configuration.box.lengths();
  box_.aspect_at_start = lengths[1] / lengths[0];
  box_.depth_at_start = lengths[Dim - 1] / lengths[0];
}

template <class Shape>
void PressureSampler<Shape>::sweep() {
  for (std::uint64_t trial = 0; trial < box_trials; ++trial)
    try_box(Stream(seed_, Purpose::box_trials, moves_.state().next_sweep, trial));
  moves_.sweep();
}

template <class Shape>
void PressureSampler<Shape>::try_box(Stream draw) {
  const double growth = draw.uniform(-box_.step.size, box_.step.size);  // change of ln V
  Vec<Dim> factors = Vec<Dim>::Constant(exponential(growth / Dim));
  if (change_ == BoxChange::anisotropic) {
    factors = Vec<Dim>::Ones();
    factors[static_cast<Eigen::Index>(draw.below(Dim))] = exponential(growth);
  }
  const double volume = configuration_.box.volume();
  const auto exponent = static_cast<double>(configuration_.size() + 1);
  const double weight = exponent * growth - pressure_ * volume * exponential_minus_one(growth);
  const bool accepted = draw.uniform() < exponential(weight) && change_box(factors);
  ++box_.tried;
  box_.accepted += accepted;
  box_.step.count(1, accepted);
}

template <class Shape>
bool PressureSampler<Shape>::change_box(const Vec<Dim>& factors) {
  const Vec<Dim>& lengths = configuration_.box.lengths();
  const Vec<Dim> at_start = detail::proportions_at_start<Dim>(box_);
  for (int k = 0; k < Dim; ++k)
    for (int l = 0; l < k; ++l) {
      const double change =
          factors[k] / factors[l] * (lengths[k] / lengths[l]) / (at_start[k] / at_start[l]);
      if (change > max_aspect_change || change < 1 / max_aspect_change) return false;
    }
  return moves_.rescale(factors);
}

template <class Shape>
void PressureSampler<Shape>::tune() {
  // Adaptations use ever more trials, so that the last step is a good one.
  constexpr std::uint64_t least = 20, share = 8;
  constexpr double widest = 0.1;
  moves_.tune();
  box_.step.tune(std::max(least, box_.tried / share), widest);
}

extern template class PressureSampler<ParticleShape<2>>;
extern template class PressureSampler<ParticleShape<3>>;

}  // namespace vitrel
