#include "mc/event_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/contact/ellipse_free_path_batch.h"
#include "mc/hard_core.h"
#include "mc/trial.h"

namespace vitrel {

namespace {

/// Gap at contact, in hard-core margins: so far above one that rounding does not matter.
constexpr double contact_margins = 1.25;
/// Initial length of chains, in √(V/N): few contacts at any density.
constexpr double initial_length = 1e-3;
/// A chain is cut short after its target number of contacts times this factor.
constexpr double max_contact_factor = 1000;

}  // namespace

EventChain::EventChain(Configuration2& configuration, const EventChainOptions& options,
                       std::uint64_t seed, const ChainState& state)
    : configuration_(configuration),
      largest_(largest_circumradius(configuration)),
      margin_(hard_margin(configuration)),
      half_box_(0.5 * configuration.box.lengths()),
      rounding_(16 * std::numeric_limits<double>::epsilon() * half_box_.maxCoeff()),
      options_(options),
      free_list_(SimdCells::none),
      seed_(seed),
      state_(state) {
  const auto particles = static_cast<double>(configuration.size());
  if (state.chains == 0) {
    state_.chains = configuration.size();
    state_.length = initial_length * std::sqrt(configuration.box.volume() / particles);
  }
  double smallest = largest_;
  axis_.reserve(configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    axis_.push_back(axis_at(configuration.angle[i]));
    smallest = std::min(smallest, configuration.shape[i].inradius());
    if (!configuration.shape[i].is_round()) rotors_.push_back(static_cast<SimdCells::Index>(i));
  }
  // The maximum contact distance of two particles (ellipse_free_path_batch.h).
  const double enlarged = 1 + 2 * contact_margins * margin_ / smallest;
  board_.emplace(configuration_.box, 2 * enlarged * largest_, configuration_.size());
}

void EventChain::set_plan(const Plan& plan) {
  state_.chains = plan.chains;
  state_.length = plan.length;
  state_.rotations = plan.rotations;
  state_.rotation.size = plan.rotation_step;
}

void EventChain::arrange() {
  const std::size_t n = configuration_.size();
  cells_.resize(board_->cells(), n);
  for (std::size_t cell = 0; cell < board_->cells(); ++cell) cells_.clear(cell);
  free_list_ = cells_.free_groups(0, n);
  for (std::size_t i = 0; i < n; ++i)
    cells_.insert(i, board_->index(board_->cell_of(configuration_.position[i])),
                  configuration_.shape[i], configuration_.position[i], axis_[i], free_list_);
}

void EventChain::sweep() {
  arrange();
  Stream draw(seed_, Purpose::trial_moves, state_.next_sweep, 0);
  const auto next = [&draw] {
    Stream::Block words;
    draw.fill({&words, 1});
    return words;
  };
  std::uint64_t rotations = 0;
  for (std::uint64_t chain = 1; chain <= state_.chains; ++chain) {
    const Stream::Block words = next();
    run_chain(pick(words[0], configuration_.size()), (words[1] & 1) == 0);
    if (rotors_.empty()) continue;
    for (; rotations < chain * state_.rotations / state_.chains; ++rotations) {
      const Stream::Block rotation = next();
      rotate(rotors_[pick(rotation[0], rotors_.size())],
             state_.rotation.size * plus_minus_one(rotation[1]));
    }
  }
  ++state_.next_sweep;
  ++state_.sweeps;
}

void EventChain::run_chain(std::size_t first, bool along_x) {
  if (rotors_.empty())
    along_x ? run<0, RoundFreePathBatch>(first) : run<1, RoundFreePathBatch>(first);
  else
    along_x ? run<0, FreePathBatch>(first) : run<1, FreePathBatch>(first);
}

template <int direction, template <int> class PathBatch>
void EventChain::run(std::size_t first) {
  ++state_.counts.chains;
  state_.counts.length += state_.length;
  const std::uint64_t begin = state_.counts.contacts;
  const auto max_contacts = static_cast<std::uint64_t>(max_contact_factor * options_.contacts);
  std::size_t moving = first;
  for (double remaining = state_.length; remaining > 0;) {
    const FreePath path = next_contact<direction, PathBatch>(moving, remaining);
    ++state_.counts.searches;
    const bool touches = path.partner != FreePath::none;
    const std::size_t next = touches ? cells_.particle_in(path.partner) : moving;
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
template <int direction, template <int> class PathBatch>
FreePath EventChain::next_contact(std::size_t i, double remaining) const {
  constexpr int across = 1 - direction;
  const Vec2 position = configuration_.position[i];
  const Checkerboard::Cell cell = board_->cell_of(position);
  const Vec2 width = board_->cell_size();
  const Vec2 into = position - board_->corner(cell);
  const double to_border = std::max(width[direction] - into[direction], 0.) + rounding_;
  PathBatch<direction> paths(configuration_.shape[i], axis_[i], contact_margins * margin_,
                             std::min(remaining, to_border));
  const double aside = paths.reach_aside(largest_) + rounding_;
  const double first_before = into[direction] - paths.reach_behind(largest_) - rounding_;
  const double lowest = into[across] - aside, highest = into[across] + aside;
  const std::size_t own = cells_.group_index(i);
  const typename PathBatch<direction>::Mask all(true);
  const typename PathBatch<direction>::Mask others = detail::all_lanes_but(cells_.lane_of(i));
  const auto columns = board_->near_columns(cell.x), rows = board_->near_rows(cell.y);
  for (const Checkerboard::NearLine& one : direction == 0 ? columns : rows) {
    const double last_after = into[direction] + paths.reach_ahead(largest_);
    if (one.begin + width[direction] < first_before || one.begin > last_after) continue;
    for (const Checkerboard::NearLine& two : direction == 0 ? rows : columns) {
      if (two.begin + width[across] < lowest || two.begin > highest) continue;
      const Checkerboard::NearLine &column = direction == 0 ? one : two,
                                   &row = direction == 0 ? two : one;
      const Vec2 offset = Vec2(column.translation, row.translation) - position;
      std::size_t at = board_->index(column.cell, row.cell);
      do {
        const SimdCells::Group& group = cells_[at];
        paths.add(group, SimdCells::first_slot(at), offset, at == own ? others : all);
        at = group.next;
      } while (at != SimdCells::none);
    }
  }
  return paths.end();
}

template <int direction>
void EventChain::advance(std::size_t i, double length) {
  SimdCells::Group& group = cells_.group_of(i);
  const int lane = cells_.lane_of(i);
  Vec2& position = configuration_.position[i];
  position[direction] += length;
  if (position[direction] >= half_box_[direction])
    configuration_.box.wrap(position, configuration_.image[i]);
  const std::size_t cell = board_->index(board_->cell_of(position));
  if (group.cell == cell) {
    (direction == 0 ? group.x : group.y)[lane] = position[direction];
  } else {
    const Ellipse shape = configuration_.shape[i];
    cells_.remove(i, free_list_);
    cells_.insert(i, cell, shape, position, axis_[i], free_list_);
  }
}

void EventChain::rotate(std::size_t i, double rotation) {
  const Ellipse& shape = configuration_.shape[i];
  const Vec2& position = configuration_.position[i];
  const double angle = configuration_.angle[i] + rotation;
  const Vec2 axis = axis_at(angle);
  OverlapTestCounts tests;
  ++state_.counts.rotations_tried;
  ++state_.rotation.tried;
  if (!clear_of_others(*board_, cells_, i, OverlapBatch(shape, axis, margin_), position,
                       board_->cell_of(position), tests) ||
      !clear_of_periodic_images(configuration_.box, shape, axis, margin_))
    return;
  ++state_.counts.rotations_accepted;
  ++state_.rotation.accepted;
  configuration_.angle[i] = angle;
  axis_[i] = axis;
  SimdCells::Group& group = cells_.group_of(i);
  const int lane = cells_.lane_of(i);
  group.ux[lane] = axis.x();
  group.uy[lane] = axis.y();
}

void EventChain::tune() {
  constexpr std::uint64_t enough_trials = 400, enough_chains = 100;
  state_.rotation.tune(enough_trials, std::numbers::pi / 2);
  const std::uint64_t chains = state_.counts.chains - state_.tuned_chains;
  if (chains < enough_chains) return;
  const double particles = static_cast<double>(configuration_.size());
  const double found = static_cast<double>(state_.counts.contacts - state_.tuned_contacts) /
                       static_cast<double>(chains);
  const double longest = options_.contacts * 2 * half_box_.maxCoeff();
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

}  // namespace vitrel
