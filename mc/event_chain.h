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

struct FreePath;

/// Targets for the tuning of event chains, whose defaults are optimal (docs/how-it-works/monte-carlo.md), and exchanges
/// of places.
struct EventChainOptions {
  double contacts = 100;  ///< per chain
  double rotations = 1;   ///< trial rotations per contact; no effect if all are round
  ExchangeOptions exchanges = {};
};

/// Totals of event chains.
struct ChainCounts {
  std::uint64_t chains = 0, contacts = 0;
  std::uint64_t cut_short = 0;  ///< chains cut short
  std::uint64_t searches = 0;   ///< free paths searched; a path also ends at each cell border
  std::uint64_t rotations_tried = 0, rotations_accepted = 0;
  ExchangeCounts exchanges;
  double length = 0;  ///< Σ l
  double ahead = 0;   ///< Σ (r_j − r_i)·e over the contacts

  /// Z, if there were chains.
  double compressibility() const { return 1 + ahead / length; }
};

/// The state of event chains: together with the configuration, sufficient to continue with bit-identical results.
struct ChainState {
  std::uint64_t next_sweep = 0;  ///< number of the next sweep, which selects its random stream
  std::uint64_t sweeps = 0;      ///< completed
  // The plan of a sweep; not yet chosen if there are no chains.
  std::uint64_t chains = 0, rotations = 0;
  double length = 0;  ///< of each chain
  StepSize rotation{0.1};
  ChainCounts counts;
  std::uint64_t tuned_chains = 0, tuned_contacts = 0;  ///< at the last adaptation
};

/// Event-chain Monte Carlo of hard ellipses or ellipsoids at constant N, box and temperature, on one thread.
///
/// A chain: a random particle moves forwards along x, y or, in space, z, each with equal probability, until it touches
/// another (ellipse_free_path_batch.h, ellipsoid_free_path_batch.h, round_free_path_batch.h). That one continues in the
/// same direction, until the paths add up to the length of the chain. Nothing is rejected. Orientations change by trial
/// rotations, as in sampler.h.
///
/// One sweep is a fixed number of chains of one length, with trial rotations of random particles spread evenly among
/// them, and exchanges of places (exchanges.h) at its end; `tune` chooses them so that a sweep has about N contacts.
/// Particles are sorted into cells at the start of a sweep. Sweep s draws from the stream (seed, trial_moves, s, 0):
/// chains that start from a stored state continue with bit-identical results.
///
/// Uniform sampling of all hard states. Divide a chain of length l along x into steps ε → 0. Each of the N lifted
/// states (hard state, moving particle i) has one successor: i moved by ε or, if it would then overlap j, the same
/// state with j moving. Conversely each has one predecessor: i moved back by ε or, if it would then overlap k behind
/// it, the same state with k moving. At fixed orientations a contact depends only on the difference of the two
/// positions, so j blocks i if and only if i blocks j in the opposite direction. A chain therefore maps lifted states
/// one to one, and conserves volume (the flow is a translation between contacts): the uniform distribution is invariant
/// (global balance), since particle and direction are drawn uniformly and independently of the state. Rotations satisfy
/// detailed balance. This does not prove ergodicity; tests compare with independently drawn states.
///
/// The pressure follows from the contacts (michel2014):
///
///     Z = βP/ρ = 1 + ⟨Σ (r_j − r_i)·e⟩/l,
///
/// the sum over the contacts of a chain along e.
///
/// In a row of particles jammed across the whole box a chain would have infinitely many contacts. A chain is cut short
/// after 1000 times the target number, which violates balance and is counted.
///
/// Contact is at 1.25 hard-core margins (hard_core.h) or slightly more (see the free paths), and rotations keep
/// one margin, so the margin always holds. A particle's own images move along with it.
/// Sources: bernard2009; for ellipses and all potentials that depend on differences michel2014.
template <int Dim>
class EventChain {
 public:
  /// The configuration must be hard, with wrapped positions, and outlive this object. Meanwhile nothing else may move
  /// or rotate particles.
  EventChain(Configuration<Dim>& configuration, const EventChainOptions& options,
             std::uint64_t seed, const ChainState& state = {});

  void sweep();

  /// Adapts the plan by the counts since the last adaptation, or waits for more: contacts and rotations as requested,
  /// about N contacts per sweep, and 0.35 of the rotations accepted. Chains are short at first, and their length at
  /// most doubles each time. Belongs to equilibration.
  void tune();

  /// The plan of a sweep. Only `tune` and `set_plan` change it.
  struct Plan {
    std::uint64_t chains;
    double length;  ///< of every chain
    std::uint64_t rotations;
    double rotation_step;
  };
  Plan plan() const {
    return {state_.chains, state_.length, state_.rotations, state_.rotation.size};
  }
  void set_plan(const Plan& plan);

  /// The state given at construction, advanced by the work since.
  const ChainState& state() const { return state_; }
  const ChainCounts& counts() const { return state_.counts; }

 private:
  template <int direction>
  void run_chain(std::size_t first);
  template <int direction, class PathBatch>
  void run(std::size_t first);
  template <int direction, class PathBatch>
  FreePath next_contact(std::size_t i, double remaining) const;
  template <int direction>
  void advance(std::size_t i, double length);
  void rotate_some(std::uint64_t& done, std::uint64_t goal, Stream& draw);
  void exchange_some(Stream& draw);

  HardParticles<Dim> particles_;
  std::optional<Exchanges<Dim>> exchanges_;
  double rounding_;  // bound of the rounding of positions
  EventChainOptions options_;
  std::vector<typename HardParticles<Dim>::Index> rotors_;  // the particles that are not round
  std::uint64_t seed_;
  ChainState state_;
};

}  // namespace vitrel
