#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/contact/ellipse_free_path_batch.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "mc/checkerboard.h"
#include "mc/simd_cells.h"
#include "mc/sweep_state.h"
#include "mc/trial.h"

namespace vitrel {

/// How event chains are tuned. The defaults are those that bench/event_chain.md found good.
struct EventChainOptions {
  double contacts = 100;  ///< of a chain
  double rotations = 1;   ///< trial rotations for every contact; of no effect if all are round
};

/// What event chains have done.
struct ChainCounts {
  std::uint64_t chains = 0, contacts = 0;
  std::uint64_t cut_short = 0;  ///< chains
  std::uint64_t searches = 0;   ///< for the next contact; a path ends at every border of cells too
  std::uint64_t rotations_tried = 0, rotations_accepted = 0;
  double length = 0;  ///< Σ l
  double ahead = 0;   ///< Σ (r_j − r_i)·e over the contacts

  /// Z, if there were chains.
  double compressibility() const { return 1 + ahead / length; }
};

/// Where event chains stand: with the configuration, all it takes to go on bit by bit.
struct ChainState {
  std::uint64_t next_sweep = 0;  ///< its number, by which it draws
  std::uint64_t sweeps = 0;      ///< made so far
  // What a sweep is; without chains it is yet to be chosen.
  std::uint64_t chains = 0, rotations = 0;
  double length = 0;  ///< of every chain
  StepSize rotation{0.1};
  ChainCounts counts;
  std::uint64_t tuned_chains = 0, tuned_contacts = 0;  ///< at the last adaptation
};

/// Event-chain Monte Carlo of hard ellipses at constant N, box and temperature, on one thread.
///
/// A chain: a random particle moves along x or along y, either with probability ½ and always forwards,
/// until it touches another (path_look.h); that one goes on from there in the same direction, until
/// the paths add up to the length of the chain. Nothing is rejected. Angles change by trial
/// rotations, uniform within ± the step, as in sampler.h.
///
/// One sweep is a fixed number of chains of one length with trial rotations of random particles spread
/// evenly among them; `tune` chooses them so that a sweep has about N contacts. Particles are sorted into cells
/// anew at the beginning. Sweep s draws from the stream (seed, trial_moves, s, 0): event chains that
/// begin with the state of others go on as these, bit by bit.
///
/// Why every hard state is as likely as any other. Cut a chain of length l along x into steps ε → 0: of
/// the N lifted states (hard state, moving particle i) each has one successor, either with i moved by
/// ε, or, if that would overlap with j, the same state with j moving. Conversely each is reached from
/// one alone: from i moved back by ε, or, if that would overlap with k behind, from the same state with k
/// moving. A contact depends on the difference of the two positions only, angles fixed, so that j is
/// in the way of i exactly if i is in the way of j going backwards. So a chain maps lifted states one
/// to one and without change of volume (the flow is a translation between contacts): the uniform
/// distribution goes into itself (global balance), the particle and direction being drawn uniformly
/// and without regard to the state. Rotations are in detailed balance.
/// That all hard states can be reached is not shown by this; tests compare with states drawn independently.
///
/// The pressure comes with the contacts (michel2014):
///     Z = βP/ρ = 1 + ⟨Σ (r_j − r_i)·e⟩/l,
/// the sum over the contacts of a chain along e.
///
/// In a row of particles that is jammed across the whole box a chain would have contacts without end: a
/// chain of 1000 times as simd_width as wanted is cut short, against the balance, and counted.
///
/// Contact is at 1.25 hard margins (disjoint.h), or a little more (path_look.h), and rotations keep one, so
/// that the margin holds always. A particle's own images move along; those of others are others.
/// Sources: bernard2009; for ellipses and all else whose potential depends on differences michel2014.
class EventChain {
 public:
  /// The configuration must be hard, with wrapped positions, and outlive the chains; nobody else may
  /// move or rotation particles meanwhile.
  EventChain(Configuration2& configuration, const EventChainOptions& options, std::uint64_t seed,
             const ChainState& state = {});

  void sweep();

  /// Adapts the plan by the counts since the last adaptation, or waits for more: contacts and rotations
  /// as asked for, about N contacts in a sweep, 0.35 of the rotations accepted. At first chains are short,
  /// and their length at most doubles each time. It belongs to equilibration.
  void tune();

  /// What a sweep is. Depends on nothing but `tune` and `set_plan`.
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

  /// As given at construction, and what has been done since.
  const ChainState& state() const { return state_; }
  const ChainCounts& counts() const { return state_.counts; }

 private:
  void arrange();
  void run_chain(std::size_t first, bool along_x);
  template <int direction, template <int> class PathBatch>
  void run(std::size_t first);
  template <int direction, template <int> class PathBatch>
  FreePath next_contact(std::size_t i, double remaining) const;
  template <int direction>
  void advance(std::size_t i, double length);
  void rotate(std::size_t i, double rotation);

  Configuration2& configuration_;
  double largest_, margin_;
  Vec2 half_box_;
  double rounding_;  // more than that of any position
  EventChainOptions options_;
  std::vector<Vec2> axis_;                // unit major axes
  std::vector<SimdCells::Index> rotors_;  // the particles that are not round
  std::optional<Checkerboard> board_;
  SimdCells cells_;
  SimdCells::FreeList free_list_;
  std::uint64_t seed_;
  ChainState state_;
};

}  // namespace vitrel
