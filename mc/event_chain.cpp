#include "mc/event_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "core/contact/ellipse_free_path_batch.h"
#include "core/contact/ellipsoid_free_path_batch.h"
#include "core/elementary.h"

namespace vitrel {

namespace {

/// Initial length of chains, in √(V/N): few contacts at any density.
constexpr double initial_length = 1e-3;
/// A chain is cut short after its target number of contacts times this factor.
constexpr double max_contact_factor = 1000;

template <int Dim>
using Cell = typename Checkerboard<Dim>::Cell;
template <int Dim>
using Translation = typename Checkerboard<Dim>::Translation;
template <int Dim>
using Line = typename Checkerboard<Dim>::NearLine;

Stream::Block next_words(Stream& draw) {
  Stream::Block words;
  draw.fill({&words, 1});
  return words;
}

/// The free paths of particle i.
template <class PathBatch, class Body>
PathBatch paths_of(const std::vector<Body>& bodies, std::size_t i, double gap, double max_length) {
  if constexpr (std::is_constructible_v<PathBatch, const Body&, double, double>)
    return PathBatch(bodies[i], gap, max_length);
  else
    return PathBatch(bodies[i], bodies.data(), gap, max_length);
}

/// Calls visit(near, translation) for the cells near one, along the directions from k to that of the path, as far as
/// `is_beside` holds for their columns, rows and layers.
template <int k, int direction, int Dim, class Keep, class Visit>
VITREL_INLINE void for_each_beside(const Checkerboard<Dim>& board, const Cell<Dim>& cell,
                                   const Keep& is_beside, Cell<Dim>& near,
                                   Translation<Dim>& translation, const Visit& visit) {
  if constexpr (k == direction) {
    visit(near, translation);
  } else {
    for (const Line<Dim>& line : board.near(cell, k)) {
      if (!is_beside(line, k)) continue;
      near[k] = line.cell;
      translation[k] = line.translation;
      for_each_beside<(k + 1) % Dim, direction>(board, cell, is_beside, near, translation, visit);
    }
  }
}

}  // namespace

template <int Dim>
EventChain<Dim>::EventChain(Configuration<Dim>& configuration, const EventChainOptions& options,
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
      rotors_.push_back(static_cast<typename HardParticles<Dim>::Index>(i));
  if (options.exchanges.any()) exchanges_.emplace(particles_, options.exchanges);
}

template <int Dim>
void EventChain<Dim>::set_plan(const Plan& plan) {
  state_.chains = plan.chains;
  state_.length = plan.length;
  state_.rotations = plan.rotations;
  state_.rotation.size = plan.rotation_step;
}

/// Rotations of random particles, until there are as many as `goal`.
template <int Dim>
void EventChain<Dim>::rotate_some(std::uint64_t& done, std::uint64_t goal, Stream& draw) {
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

template <int Dim>
void EventChain<Dim>::exchange_some(Stream& draw) {
  OverlapTestCounts tests;
  exchanges_->try_all(draw, state_.counts.exchanges, tests);
  exchanges_->run_chain(draw, state_.counts.exchanges, tests);
}

template <int Dim>
void EventChain<Dim>::sweep() {
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

template <int Dim>
template <int direction>
void EventChain<Dim>::run_chain(std::size_t first) {
  if (rotors_.empty())
    run<direction, RoundFreePathBatch<direction, Dim>>(first);
  else if constexpr (Dim == 2)
    run<direction, EllipseFreePathBatch<direction>>(first);
  else
    run<direction, EllipsoidFreePathBatch<direction>>(first);
}

template <int Dim>
template <int direction, class PathBatch>
void EventChain<Dim>::run(std::size_t first) {
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

// Stops just beyond the border of the cell, where other particles come within reach.
template <int Dim>
template <int direction, class PathBatch>
FreePath EventChain<Dim>::next_contact(std::size_t i, double remaining) const {
  const auto& board = particles_.board();
  const auto& cells = particles_.cells();
  const double largest = particles_.largest();
  const Vec<Dim> position = particles_.configuration().position[i];
  const Cell<Dim> cell = board.cell_of(position);
  const Vec<Dim> width = board.cell_size();
  const Vec<Dim> into = position - board.corner(cell);
  const double to_border = std::max(width[direction] - into[direction], 0.) + rounding_;
  PathBatch paths = paths_of<PathBatch>(particles_.bodies(), i,
                                        HardParticles<Dim>::contact_margins * particles_.margin(),
                                        std::min(remaining, to_border));
  const double aside = paths.reach_aside(largest) + rounding_;
  const double first_before = into[direction] - paths.reach_behind(largest) - rounding_;
  const std::size_t own = cells.group_index(i);
  const SimdBatch::Mask all(true), others = detail::all_lanes_but(cells.lane_of(i));
  const auto add = [&](const Cell<Dim>& near, const Translation<Dim>& translation) {
    const Vec<Dim> offset = offset_of<Dim>(translation, position);
    std::size_t at = board.index(near);
    do {
      const auto& group = cells[at];
      paths.add(group, SimdCells<Dim>::first_slot(at), offset, at == own ? others : all);
      at = group.next;
    } while (at != SimdCells<Dim>::none);
  };
  const auto is_beside = [&](const Line<Dim>& line, int k) {
    return line.begin + width[k] >= into[k] - aside && line.begin <= into[k] + aside;
  };
  Cell<Dim> near;
  Translation<Dim> translation;
  for (const Line<Dim>& line : board.near(cell, direction)) {
    const double last_after = into[direction] + paths.reach_ahead(largest);
    if (line.begin + width[direction] < first_before || line.begin > last_after) continue;
    near[direction] = line.cell;
    translation[direction] = line.translation;
    for_each_beside<(direction + 1) % Dim, direction>(board, cell, is_beside, near, translation,
                                                      add);
  }
  return paths.end();
}

template <int Dim>
template <int direction>
void EventChain<Dim>::advance(std::size_t i, double length) {
  Vec<Dim> position = particles_.configuration().position[i];
  position[direction] += length;
  Shift<Dim> crossed = Shift<Dim>::Zero();
  if (position[direction] >= particles_.half_box()[direction])
    particles_.configuration().box.wrap(position, crossed);
  const auto& board = particles_.board();
  particles_.move(i, position, crossed, board.index(board.cell_of(position)),
                  particles_.free_list(0));
}

template <int Dim>
void EventChain<Dim>::tune() {
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

template class EventChain<2>;
template class EventChain<3>;

}  // namespace vitrel
