#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "core/contact/resting_bodies.h"
#include "core/contact/round_free_path_batch.h"
#include "core/elementary.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "mc/exchanges.h"
#include "mc/hard_particles.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// Options of event chains: targets of their tuning, whose defaults are optimal (docs/how-it-works/monte-carlo.md), and
/// exchanges of places.
struct EventChainOptions {
  double contacts = 100;  ///< contacts per chain
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
  double length = 0;  ///< Σ l over the chains
  double ahead = 0;   ///< Σ (r_j − r_i)·e over the contacts

  /// Returns Z; there must have been chains.
  double compressibility() const { return 1 + ahead / length; }
};

/// The state of event chains, which together with the configuration suffices to continue with bit-identical results.
struct ChainState {
  std::uint64_t next_sweep = 0;  ///< number of the next sweep, which selects its random stream
  std::uint64_t sweeps = 0;      ///< number of completed sweeps
  // The plan of a sweep; it is not yet chosen if `chains` is 0.
  std::uint64_t chains = 0, rotations = 0;
  double length = 0;  ///< length of each chain
  StepSize rotation{0.1};
  ChainCounts counts;
  std::uint64_t tuned_chains = 0, tuned_contacts = 0;  ///< counts at the last adaptation
};

/// Event-chain Monte Carlo of hard bodies at constant N, box and temperature, on one thread.
///
/// In a chain, a random particle moves forwards along x, y or, in space, z, each with equal probability, until it
/// touches another one (by the free paths of resting_bodies.h, or round_free_path_batch.h). The other one continues in
/// the same direction, until the paths add up to the length of the chain. Nothing is rejected. Orientations change by
/// trial rotations, as in sampler.h.
///
/// One sweep is a fixed number of chains of one length, with trial rotations of random particles spread evenly among
/// them, and exchanges of places (exchanges.h) at its end; `tune` chooses number and length of the chains so that a
/// sweep has about N contacts. Particles are sorted into cells at the start of a sweep. Sweep s draws from the stream
/// (seed, trial_moves, s, 0), so chains that start from a stored state continue with bit-identical results.
///
/// All hard states are sampled uniformly, for the following reason. Divide a chain of length l along x into steps
/// ε → 0. Each of the N lifted states (hard state, moving particle i) has one successor: i moved by ε or, if it would
/// then overlap j, the same state with j moving. Conversely each has one predecessor: i moved back by ε or, if it would
/// then overlap k behind it, the same state with k moving. At fixed orientations a contact depends only on the
/// difference of the two positions, so j blocks i if and only if i blocks j in the opposite direction. A chain
/// therefore maps lifted states one to one, and conserves volume (the flow is a translation between contacts). Since
/// particle and direction are drawn uniformly and independently of the state, the uniform distribution is invariant
/// (global balance). Rotations satisfy detailed balance. This does not prove ergodicity; tests compare with
/// independently drawn states.
///
/// The pressure follows from the contacts (michel2014):
///
///     Z = βP/ρ = 1 + ⟨Σ (r_j − r_i)·e⟩/l,
///
/// where the sum runs over the contacts of a chain along e.
///
/// In a row of particles jammed across the whole box, a chain would have infinitely many contacts. A chain is therefore
/// cut short after 1000 times the target number, which violates balance and is counted.
///
/// The gap at contact is 1.25 hard-core margins (hard_core.h) or slightly more (see the free paths), and rotations keep
/// one margin, so the margin always holds. A particle's own images move along with it. Sources: bernard2009, and
/// michel2014 for ellipses and all potentials that depend on differences.
template <class Shape>
class EventChain {
 public:
  static constexpr int Dim = Shape::dimension;
  /// The configuration must be hard, with wrapped positions, and outlive this object. As long as this object is used,
  /// nothing else may move or rotate particles.
  EventChain(Configuration<Dim>& configuration, const EventChainOptions& options,
             std::uint64_t seed, const ChainState& state = {});

  void sweep();

  /// Adapts the plan to the counts since the last adaptation, unless they are too few. Chains then have the requested
  /// contacts and rotations, a sweep has about N contacts, and 0.35 of the rotations are accepted. Chains are short at
  /// first, and their length at most doubles each time. Only an equilibration may call this.
  void tune();

  /// The plan of a sweep, which only `tune` and `set_plan` change.
  struct Plan {
    std::uint64_t chains;
    double length;  ///< length of every chain
    std::uint64_t rotations;
    double rotation_step;
  };
  Plan plan() const {
    return {state_.chains, state_.length, state_.rotations, state_.rotation.size};
  }
  void set_plan(const Plan& plan);

  /// Returns the state given at construction, advanced by the work since.
  const ChainState& state() const { return state_; }
  const ChainCounts& counts() const { return state_.counts; }

 private:
  using Cell = typename Checkerboard<Dim>::Cell;
  using Translation = typename Checkerboard<Dim>::Translation;
  using Line = typename Checkerboard<Dim>::NearLine;
  using Cells = typename HardParticles<Shape>::Cells;

  /// Initial length of chains in (V/N)^(1/D): they have few contacts at any density.
  static constexpr double initial_length = 1e-3;
  /// A chain is cut short after its target number of contacts times this factor.
  static constexpr double max_contact_factor = 1000;

  static Stream::Block next_words(Stream& draw) {
    Stream::Block words;
    draw.fill({&words, 1});
    return words;
  }
  /// Calls visit(near, translation) for the cells near `cell`, along the directions from k up to that of the path, in
  /// those columns, rows and layers for which `is_beside` holds.
  template <int k, int direction, class Keep, class Visit>
  static void for_each_beside(const Checkerboard<Dim>& board, const Cell& cell,
                              const Keep& is_beside, Cell& near, Translation& translation,
                              const Visit& visit);

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

  HardParticles<Shape> particles_;
  std::optional<Exchanges<Shape>> exchanges_;
  double rounding_;  // bound of the rounding of positions
  EventChainOptions options_;
  std::vector<typename HardParticles<Shape>::Index> rotors_;  // the particles that are not round
  std::uint64_t seed_;
  ChainState state_;
};

template <int Dim>
EventChain(Configuration<Dim>&, const EventChainOptions&, std::uint64_t, const ChainState& = {})
    -> EventChain<ParticleShape<Dim>>;

template <class Shape>
EventChain<Shape>::EventChain(Configuration<Dim>& configuration, const EventChainOptions& options,
                              std::uint64_t seed, const ChainState& state)
    : particles_(configuration),
      rounding_(16 * std::numeric_limits<double>::epsilon() * particles_.half_box().maxCoeff()),
      options_(options),
      seed_(seed),
      state_(state) {
  const auto particles = static_cast<double>(configuration.size());
  if (state.chains == 0) {
    state_.chains = configuration.size();
    state_.length = initial_length * root(configuration.box.volume() / particles, Dim);
  }
  for (std::size_t i = 0; i < configuration.size(); ++i)
    if (!configuration.shape[i].is_round())
      rotors_.push_back(static_cast<typename HardParticles<Shape>::Index>(i));
  if (options.exchanges.any()) exchanges_.emplace(particles_, options.exchanges);
}

template <class Shape>
void EventChain<Shape>::set_plan(const Plan& plan) {
  state_.chains = plan.chains;
  state_.length = plan.length;
  state_.rotations = plan.rotations;
  state_.rotation.size = plan.rotation_step;
}

/// Tries rotations of random particles until `done` reaches `goal`.
template <class Shape>
void EventChain<Shape>::rotate_some(std::uint64_t& done, std::uint64_t goal, Stream& draw) {
  for (; done < goal; ++done) {
    const Stream::Block words = next_words(draw);
    Vec<Dim> turn;
    for (int k = 0; k < Dim; ++k)
      turn[k] = state_.rotation.size * plus_minus_one(words[static_cast<std::size_t>(k) + 1]);
    OverlapTestCounts tests;
    const bool accepted = particles_.try_turn(rotors_[pick(words[0], rotors_.size())], turn, tests);
    ++state_.counts.rotations_tried;
    state_.counts.rotations_accepted += accepted;
    state_.rotation.count(1, accepted);
  }
}

template <class Shape>
void EventChain<Shape>::exchange_some(Stream& draw) {
  OverlapTestCounts tests;
  exchanges_->try_all(draw, state_.counts.exchanges, tests);
  exchanges_->run_chain(draw, state_.counts.exchanges, tests);
}

template <class Shape>
void EventChain<Shape>::sweep() {
  particles_.arrange();
  Stream draw(seed_, Purpose::trial_moves, state_.next_sweep, 0);
  std::uint64_t rotations = 0;
  for (std::uint64_t chain = 1; chain <= state_.chains; ++chain) {
    const Stream::Block words = next_words(draw);
    const std::size_t first = pick(words[0], particles_.configuration().size());
    if constexpr (Dim == 2)
      (words[1] & 1) == 0 ? run_chain<0>(first) : run_chain<1>(first);
    else if (const std::size_t direction = pick(words[1], 3); direction == 0)
      run_chain<0>(first);
    else
      direction == 1 ? run_chain<1>(first) : run_chain<2>(first);
    if (!rotors_.empty()) rotate_some(rotations, chain * state_.rotations / state_.chains, draw);
  }
  if (exchanges_) exchange_some(draw);
  ++state_.next_sweep;
  ++state_.sweeps;
}

template <class Shape>
template <int direction>
void EventChain<Shape>::run_chain(std::size_t first) {
  if (rotors_.empty())
    run<direction, RoundFreePathBatch<direction, Dim>>(first);
  else
    run<direction, typename RestingBodies<Shape>::template FreePaths<direction>>(first);
}

template <class Shape>
template <int direction, class PathBatch>
void EventChain<Shape>::run(std::size_t first) {
  ++state_.counts.chains;
  state_.counts.length += state_.length;
  const std::uint64_t begin = state_.counts.contacts;
  const auto max_contacts = static_cast<std::uint64_t>(max_contact_factor * options_.contacts);
  std::size_t moving = first;
  for (double remaining = state_.length; remaining > 0;) {
    const FreePath path = next_contact<direction, PathBatch>(moving, remaining);
    ++state_.counts.searches;
    const bool touches = path.partner != FreePath::none;
    const std::size_t next = touches ? particles_.cells().particle_in(path.partner) : moving;
    advance<direction>(moving, path.length);
    remaining -= path.length;
    if (!touches) continue;
    ++state_.counts.contacts;
    state_.counts.ahead += path.offset_at_contact;
    moving = next;
    if (state_.counts.contacts - begin == max_contacts) {
      ++state_.counts.cut_short;
      return;
    }
  }
}

template <class Shape>
template <int k, int direction, class Keep, class Visit>
VITREL_INLINE void EventChain<Shape>::for_each_beside(const Checkerboard<Dim>& board,
                                                      const Cell& cell, const Keep& is_beside,
                                                      Cell& near, Translation& translation,
                                                      const Visit& visit) {
  if constexpr (k == direction) {
    visit(near, translation);
  } else {
    for (const Line& line : board.near(cell, k)) {
      if (!is_beside(line, k)) continue;
      near[k] = line.cell;
      translation[k] = line.translation;
      for_each_beside<(k + 1) % Dim, direction>(board, cell, is_beside, near, translation, visit);
    }
  }
}

// The path ends at the latest just beyond the border of the cell, where other particles come within reach.
template <class Shape>
template <int direction, class PathBatch>
FreePath EventChain<Shape>::next_contact(std::size_t i, double remaining) const {
  const auto& board = particles_.board();
  const auto& cells = particles_.cells();
  const double largest = particles_.largest();
  const Vec<Dim> position = particles_.configuration().position[i];
  const Cell cell = board.cell_of(position);
  const Vec<Dim> width = board.cell_size();
  const Vec<Dim> into = position - board.corner(cell);
  const double to_border = std::max(width[direction] - into[direction], 0.) + rounding_;
  PathBatch paths(particles_.bodies()[i], particles_.bodies().data(),
                  HardParticles<Shape>::contact_margins * particles_.margin(),
                  std::min(remaining, to_border));
  const double aside = paths.reach_aside(largest) + rounding_;
  const double first_before = into[direction] - paths.reach_behind(largest) - rounding_;
  const std::size_t own = cells.group_index(i);
  const SimdBatch::Mask all(true), others = detail::all_lanes_but(cells.lane_of(i));
  const auto add = [&](const Cell& near, const Translation& translation) {
    const Vec<Dim> offset = offset_of<Dim>(translation, position);
    std::size_t at = board.index(near);
    do {
      const auto& group = cells[at];
      paths.add(group, Cells::first_slot(at), offset, at == own ? others : all);
      at = group.next;
    } while (at != Cells::none);
  };
  const auto is_beside = [&](const Line& line, int k) {
    return line.begin + width[k] >= into[k] - aside && line.begin <= into[k] + aside;
  };
  Cell near;
  Translation translation;
  for (const Line& line : board.near(cell, direction)) {
    const double last_after = into[direction] + paths.reach_ahead(largest);
    if (line.begin + width[direction] < first_before || line.begin > last_after) continue;
    near[direction] = line.cell;
    translation[direction] = line.translation;
    for_each_beside<(direction + 1) % Dim, direction>(board, cell, is_beside, near, translation,
                                                      add);
  }
  return paths.end();
}

template <class Shape>
template <int direction>
void EventChain<Shape>::advance(std::size_t i, double length) {
  Vec<Dim> position = particles_.configuration().position[i];
  position[direction] += length;
  Shift<Dim> crossed = Shift<Dim>::Zero();
  if (position[direction] >= particles_.half_box()[direction])
    particles_.configuration().box.wrap(position, crossed);
  const auto& board = particles_.board();
  particles_.move(i, position, crossed, board.index(board.cell_of(position)),
                  particles_.free_list(0));
}

template <class Shape>
void EventChain<Shape>::tune() {
  constexpr std::uint64_t enough_trials = 400, enough_chains = 100;
  state_.rotation.tune(enough_trials, std::numbers::pi / 2);
  const std::uint64_t chains = state_.counts.chains - state_.tuned_chains;
  if (chains < enough_chains) return;
  const double particles = static_cast<double>(particles_.configuration().size());
  const double found = static_cast<double>(state_.counts.contacts - state_.tuned_contacts) /
                       static_cast<double>(chains);
  const double longest = options_.contacts * 2 * particles_.half_box().maxCoeff();
  const double length =
      std::min(longest, state_.length * std::clamp(options_.contacts / found, 0.125, 2.));
  const double expected = std::max(1., found * length / state_.length);
  state_.length = length;
  state_.chains = static_cast<std::uint64_t>(std::lround(std::max(1., particles / expected)));
  state_.rotations = static_cast<std::uint64_t>(
      std::lround(options_.rotations * expected * static_cast<double>(state_.chains)));
  state_.tuned_chains = state_.counts.chains;
  state_.tuned_contacts = state_.counts.contacts;
}

extern template class EventChain<ParticleShape<2>>;
extern template class EventChain<ParticleShape<3>>;

}  // namespace vitrel
