#include "mc/swelling.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "core/elementary.h"
#include "core/tolerances.h"
#include "mc/hard_core.h"
#include "mc/sampler.h"

namespace vitrel {

namespace {

/// The maximum number of sweeps for a round, and the number up to which a round is fast.
constexpr std::uint64_t max_sweeps_per_round = 40, fast_sweeps = 12;
/// Limits of the growth g − 1 in one round.
constexpr double smallest_growth = 1e-9, largest_growth = SwellingState().growth;
/// The share of the distance to first contact that is used, so that pairs keep space to move.
constexpr double share = 0.95;
/// Particles are jammed if the packing fraction rises by less than this relative amount in this number of sweeps.
constexpr std::uint64_t jamming_sweeps = 5000;
constexpr double jamming_rise = 1e-4;

template <int Dim>
class Swelling {
 public:
  Swelling(Configuration<Dim>& configuration, const SwellingOptions& options, std::uint64_t seed,
           SwellingState& state)
      : configuration_(configuration),
        options_(options),
        shapes_(configuration.shape),
        seed_(seed),
        state_(state) {}

  StageReport run(const RunControl& control) {
    const double start = packing_fraction(configuration_);
    if (start > options_.packing_fraction) finish();
    while (!reached()) {
      if (used_up(state_.moves)) return stuck("used up its sweeps");
      if (jammed()) return stuck("found the particles jammed");
      if (!round(control)) return {StageEnd::stopped, "swelling was stopped"};
      const double now = packing_fraction(configuration_);
      control.report_progress(
          {(now - start) / (options_.packing_fraction - start), now, "packing fraction"});
      control.notify_resumable();
    }
    return {StageEnd::reached, "the packing fraction was reached"};
  }

 private:
  bool reached() const {
    return packing_fraction(configuration_) >=
           options_.packing_fraction * (1 - tolerance::given_fraction);
  }
  bool used_up(const SweepState& moves) const { return moves.sweeps >= options_.sweeps; }

  bool jammed() {
    if (state_.moves.sweeps - state_.checked_sweeps < jamming_sweeps) return false;
    const double before = state_.checked_packing_fraction;
    state_.checked_sweeps = state_.moves.sweeps;
    state_.checked_packing_fraction = packing_fraction(configuration_);
    return state_.checked_packing_fraction < before * (1 + jamming_rise);
  }

  StageReport stuck(const std::string& how) const {
    return {StageEnd::stalled, "swelling " + how + " at a packing fraction of " +
                                   std::to_string(packing_fraction(configuration_)) + " after " +
                                   std::to_string(state_.moves.sweeps) + " sweeps; the target is " +
                                   std::to_string(options_.packing_fraction)};
  }

  // Makes one round, starting from the current growth, and adapts the growth of the next round. Returns false if
  // stopped; the round then has not begun.
  bool round(const RunControl& control) {
    const Configuration<Dim> before = configuration_;
    const SweepState began = state_.moves;
    const double needed =
        root(options_.packing_fraction / packing_fraction(configuration_), Dim) - 1;
    double growth = std::min(state_.growth, needed);
    const Outcome outcome = enlarge_all(growth, control);
    configuration_.shape = shapes_;
    if (outcome == Outcome::stopped) {
      configuration_ = before;
      state_.moves = began;
      return false;
    }
    if (outcome == Outcome::no_room)
      shrink_to_closest_pair();
    else if (growth == needed)
      finish();
    else
      scale_box(configuration_, 1 / (1 + growth));
    state_.growth = state_.moves.sweeps - began.sweeps <= fast_sweeps
                        ? std::min(largest_growth, 1.5 * state_.growth)
                        : std::max(smallest_growth, growth);
    // If rounding alone costs a pair its margin, the round is discarded.
    if (find_overlap(configuration_)) configuration_ = before;
    return true;
  }

  enum class Outcome { all, no_room, stopped };

  // Alternates sweeps and enlargements of single particles. If some find no space, the growth is halved for all.
  Outcome enlarge_all(double& growth, const RunControl& control) {
    Sampler sampler(configuration_, seed_, state_.moves, options_.threads);
    std::vector<std::size_t> waiting(configuration_.size());
    std::iota(waiting.begin(), waiting.end(), 0);
    while (true) {
      const Outcome outcome = enlarge_waiting(sampler, waiting, growth, control);
      state_.moves = sampler.state();
      if (outcome != Outcome::no_room || used_up(state_.moves) || growth <= smallest_growth)
        return outcome;
      growth *= 0.5;
      for (std::size_t i = 0; i < shapes_.size(); ++i)
        if (configuration_.shape[i].circumradius() != shapes_[i].circumradius())
          configuration_.shape[i] = scaled(shapes_[i], 1 + growth);
    }
  }

  Outcome enlarge_waiting(Sampler<ParticleShape<Dim>>& sampler, std::vector<std::size_t>& waiting,
                          double growth, const RunControl& control) {
    for (std::uint64_t k = 0; k < max_sweeps_per_round && !waiting.empty(); ++k) {
      if (used_up(sampler.state())) return Outcome::no_room;
      if (control.stop_requested()) return Outcome::stopped;
      sampler.sweep();
      sampler.tune();
      std::erase_if(waiting, [&](std::size_t i) {
        return sampler.reshape(i, scaled(shapes_[i], 1 + growth));
      });
    }
    return waiting.empty() ? Outcome::all : Outcome::no_room;
  }

  void shrink_to_closest_pair() {
    const double needed = root(packing_fraction(configuration_) / options_.packing_fraction, Dim);
    const double lowest = std::max(needed, 1 / (1 + largest_growth));
    const double factor = 1 - share * (1 - shrink_to_contact(configuration_, lowest));
    if (factor < 1) scale_box(configuration_, factor);
  }

  void finish() { scale_to_packing_fraction(configuration_, options_.packing_fraction); }

  Configuration<Dim>& configuration_;
  const SwellingOptions& options_;
  const std::vector<ParticleShape<Dim>> shapes_;
  const std::uint64_t seed_;
  SwellingState& state_;
};

}  // namespace

template <int Dim>
StageReport swell(Configuration<Dim>& configuration, const SwellingOptions& options,
                  std::uint64_t seed, SwellingState& state, const RunControl& control) {
  return Swelling(configuration, options, seed, state).run(control);
}

template StageReport swell(Configuration2&, const SwellingOptions&, std::uint64_t, SwellingState&,
                           const RunControl&);
template StageReport swell(Configuration3&, const SwellingOptions&, std::uint64_t, SwellingState&,
                           const RunControl&);

}  // namespace vitrel
