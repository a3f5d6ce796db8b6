#include "mc/sampler.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "core/parallel.h"
#include "mc/hard_core.h"

namespace vitrel {

namespace {

void swap_orientations(OrientedEllipse& one, OrientedEllipse& two) {
  std::swap(one.axis, two.axis);
}
void swap_orientations(OrientedEllipsoid& one, OrientedEllipsoid& two) {
  const Quaternion of_one = one.orientation;
  one = {one.shape, two.orientation};
  two = {two.shape, of_one};
}

/// Maximum distance of centres at which `reshape` must test.
double reach_of(double largest, double margin) {
  return 2 * (largest + margin);
}

}  // namespace

template <int Dim>
struct Sampler<Dim>::DomainContext {
  std::size_t domain;
  typename SimdCells<Dim>::FreeList& free_list;
  Tally& tally;
};

template <int Dim>
Sampler<Dim>::Sampler(Configuration<Dim>& configuration, std::uint64_t seed,
                      const SweepState& state, int threads)
    : configuration_(configuration),
      largest_(largest_circumradius(configuration)),
      threads_(threads),
      bodies_(oriented_bodies(configuration)),
      seed_(seed),
      state_(state) {
  fit_box();
}

template <int Dim>
void Sampler<Dim>::fit_box() {
  margin_ = hard_margin(configuration_);
  half_box_ = 0.5 * configuration_.box.lengths();
  shortest_side_ = configuration_.box.lengths().minCoeff();
  fit_board();
}

template <int Dim>
void Sampler<Dim>::fit_board() {
  board_.emplace(configuration_.box, reach_of(largest_, margin_), configuration_.size());
  arrange();
}

template <int Dim>
void Sampler<Dim>::set_steps(double translation, double rotation) {
  state_.translation.size = translation;
  state_.rotation.size = rotation;
}

template <int Dim>
void Sampler<Dim>::sweep() {
  Stream draw(seed_, Purpose::trial_moves, state_.next_sweep, 0);
  board_->shift(draw);
  arrange();
  const auto colours = board_->colours();
  std::vector<std::size_t> order(colours.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[draw.below(k)]);
  for (const std::size_t colour : order) sweep_domains(colours[colour]);
  ++state_.next_sweep;
  ++state_.sweeps;
}

// Counting sort of all particles into the cells.
template <int Dim>
void Sampler<Dim>::arrange() {
  const std::size_t n = configuration_.size();
  order_.resize(n);
  cell_of_.resize(n);
  begin_.assign(board_->cells(), 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t cell = board_->index(board_->cell_of(configuration_.position[i]));
    cell_of_[i] = static_cast<typename Cells::Index>(cell);
    ++begin_[cell];
  }
  domain_begin_.clear();
  typename Cells::Index before = 0;
  for (std::size_t domain = 0; domain < board_->domains(); ++domain) {
    domain_begin_.push_back(before);
    board_->for_each_cell(domain,
                          [&](std::size_t cell) { before += std::exchange(begin_[cell], before); });
  }
  domain_begin_.push_back(before);
  for (std::size_t i = 0; i < n; ++i)
    order_[begin_[cell_of_[i]]++] = static_cast<typename Cells::Index>(i);

  cells_.resize(board_->cells(), n);
  free_lists_.assign(board_->domains(), typename Cells::FreeList(Cells::none));
  in_parallel(board_->domains(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t domain = begin; domain < end; ++domain) fill_domain(domain);
  });
}

template <int Dim>
void Sampler<Dim>::fill_domain(std::size_t domain) {
  board_->for_each_cell(domain, [&](std::size_t cell) { cells_.clear(cell); });
  const std::size_t begin = domain_begin_[domain], end = domain_begin_[domain + 1];
  free_lists_[domain] = cells_.free_groups(begin, end);
  for (std::size_t k = begin; k < end; ++k) {
    const std::size_t i = order_[k];
    // It may have shrunk.
    if (bodies_[i].shape != configuration_.shape[i])
      bodies_[i] = oriented(configuration_.shape[i], orientations(configuration_)[i]);
    cells_.insert(i, cell_of_[i], bodies_[i], configuration_.position[i], free_lists_[domain]);
  }
}

template <int Dim>
void Sampler<Dim>::sweep_domains(const std::vector<std::size_t>& domains) {
  std::mutex adding;
  in_parallel(domains.size(), threads_, [&](std::size_t begin, std::size_t end) {
    Tally mine;
    for (std::size_t k = begin; k < end; ++k) sweep_domain(domains[k], mine);
    const std::lock_guard lock(adding);
    add(mine);
  });
}

template <int Dim>
void Sampler<Dim>::sweep_domain(std::size_t domain, Tally& tally) {
  const std::span members(order_.data() + domain_begin_[domain],
                          order_.data() + domain_begin_[domain + 1]);
  Stream draw(seed_, Purpose::trial_moves, state_.next_sweep, domain + 1);
  DomainContext context{domain, free_lists_[domain], tally};
  // Draws several blocks at a time, so that independent evaluations of the generator overlap.
  std::array<Words, 16> drawn;
  for (std::size_t done = 0; done < members.size(); done += drawn.size()) {
    const std::span trials(drawn.data(), std::min(drawn.size(), members.size() - done));
    draw.fill(trials);
    for (const Words& words : trials) {
      const std::size_t i = members[pick(words[0], members.size())];
      if (is_exchange(words[3])) {
        exchange(i, members[pick(words[1], members.size())], context);
        continue;
      }
      if (!body_of(i).shape.is_round() && (words[3] & 1) == 1)
        rotate(i, words, context);
      else
        translate(i, words, context);
    }
  }
}

/// Of a translation or rotation, each component between −1 and 1, symmetric about 0.
template <int Dim>
Vec<Dim> Sampler<Dim>::step(const Words& words) const {
  if constexpr (Dim == 2)
    return {plus_minus_one(words[1]), plus_minus_one(words[2])};
  else
    return {plus_minus_one(words[1]), plus_minus_one(words[2]), share_above(words[3], exchanges_)};
}

// In the plane the cells hold it.
template <int Dim>
decltype(auto) Sampler<Dim>::body_of(std::size_t i) const {
  if constexpr (Dim == 2)
    return cells_[cells_.group_index(i)].body(cells_.lane_of(i));
  else
    return (bodies_[i]);
}

template <int Dim>
void Sampler<Dim>::translate(std::size_t i, const Words& words, DomainContext& context) {
  auto& group = cells_.group_of(i);
  const int lane = cells_.lane_of(i);
  Vec<Dim> position = group.position(lane) + state_.translation.size * step(words);
  Shift<Dim> crossed = Shift<Dim>::Zero();
  if (((position.array().abs() >= half_box_.array())).any())
    configuration_.box.wrap(position, crossed);
  ++context.tally.counts.translations_tried;
  const Cell cell = board_->cell_of(position);
  if (board_->domain_of(cell) != context.domain) return;
  // Own images move along: their distances stay whole box lengths.
  const auto& body = body_of(i);
  if (!clear_of_others(*board_, cells_, i, body, bodies_, margin_, position, cell,
                       context.tally.overlap_tests))
    return;
  ++context.tally.counts.translations_accepted;
  configuration_.position[i] = position;
  configuration_.image[i] += crossed;
  if (group.cell == board_->index(cell)) {
    group.move(lane, position);
  } else {
    cells_.remove(i, context.free_list);
    cells_.insert(i, board_->index(cell), body, position, context.free_list);
  }
}

template <int Dim>
void Sampler<Dim>::rotate(std::size_t i, const Words& words, DomainContext& context) {
  Orientation<Dim>& orientation = orientations(configuration_)[i];
  const Vec<Dim> turn = state_.rotation.size * step(words);
  const Orientation<Dim> trial = rotated(configuration_.shape[i], orientation, turn);
  const Body body = oriented(configuration_.shape[i], trial);
  ++context.tally.counts.rotations_tried;
  if (!is_clear(i, body, configuration_.position[i], margin_, context.tally.overlap_tests)) return;
  ++context.tally.counts.rotations_accepted;
  orientation = trial;
  bodies_[i] = body;
  cells_.group_of(i).turn(cells_.lane_of(i), body);
}

template <int Dim>
void Sampler<Dim>::exchange(std::size_t i, std::size_t j, DomainContext& context) {
  const Solid<Dim>& shape_i = configuration_.shape[i];
  const Solid<Dim>& shape_j = configuration_.shape[j];
  if (shape_i == shape_j) return;
  ++context.tally.counts.exchanges_tried;
  swap_places(i, j);
  const bool i_is_larger = shape_i.volume() > shape_j.volume();
  if (!fits(i_is_larger ? i : j, context.tally.overlap_tests) ||
      !fits(i_is_larger ? j : i, context.tally.overlap_tests)) {
    swap_places(i, j);
    return;
  }
  ++context.tally.counts.exchanges_accepted;
}

/// Positions and orientations; shapes stay.
template <int Dim>
void Sampler<Dim>::swap_places(std::size_t i, std::size_t j) {
  cells_.exchange(i, j);
  std::swap(configuration_.position[i], configuration_.position[j]);
  std::swap(configuration_.image[i], configuration_.image[j]);
  auto& orientation = orientations(configuration_);
  std::swap(orientation[i], orientation[j]);
  swap_orientations(bodies_[i], bodies_[j]);
}

// Whether particle i keeps the margin where it is.
template <int Dim>
bool Sampler<Dim>::fits(std::size_t i, OverlapTestCounts& tests) const {
  return is_clear(i, bodies_[i], configuration_.position[i], margin_, tests);
}

template <int Dim>
bool Sampler<Dim>::is_clear(std::size_t i, const Body& body, const Vec<Dim>& position,
                            double margin, OverlapTestCounts& tests) const {
  return clear_of_others(*board_, cells_, i, body, bodies_, margin, position,
                         board_->cell_of(position), tests) &&
         clear_of_itself(body, margin);
}

template <int Dim>
bool Sampler<Dim>::reshape(std::size_t i, const Solid<Dim>& shape) {
  if (shape.circumradius() > largest_) {
    largest_ = shape.circumradius();
    fit_board();
  }
  const Vec<Dim>& position = configuration_.position[i];
  const Body body = oriented(shape, orientations(configuration_)[i]);
  if (!is_clear(i, body, position, 2 * margin_, overlap_tests_)) return false;
  configuration_.shape[i] = shape;
  bodies_[i] = body;
  cells_.group_of(i).set(cells_.lane_of(i), body, position);
  return true;
}

template <int Dim>
bool Sampler<Dim>::rescale(const Vec<Dim>& factors) {
  const PeriodicBox<Dim> box = configuration_.box;
  const std::vector<Vec<Dim>> position = configuration_.position;
  const std::vector<Shift<Dim>> image = configuration_.image;
  scale_box(configuration_, factors);
  fit_box();
  if (is_hard()) return true;
  configuration_.box = box;
  configuration_.position = position;
  configuration_.image = image;
  fit_box();
  return false;
}

// Tests every pair twice.
template <int Dim>
bool Sampler<Dim>::is_hard() {
  std::atomic<bool> hard = true;
  std::mutex adding;
  in_parallel(order_.size(), threads_, [&](std::size_t begin, std::size_t end) {
    OverlapTestCounts mine;
    for (std::size_t k = begin; k < end && hard; ++k) {
      if (!fits(order_[k], mine)) hard = false;
    }
    const std::lock_guard lock(adding);
    overlap_tests_.batches += mine.batches;
    overlap_tests_.scalar_pairs += mine.scalar_pairs;
  });
  return hard;
}

template <int Dim>
bool Sampler<Dim>::clear_of_itself(const Body& body, double margin) const {
  return shortest_side_ >= 2 * body.shape.circumradius() + margin ||
         clear_of_periodic_images(configuration_.box, body.shape, axes_of(body), margin);
}

template <int Dim>
void Sampler<Dim>::add(const Tally& tally) {
  const TrialCounts& more = tally.counts;
  state_.counts.add(more);
  state_.translation.count(more.translations_tried, more.translations_accepted);
  state_.rotation.count(more.rotations_tried, more.rotations_accepted);
  overlap_tests_.batches += tally.overlap_tests.batches;
  overlap_tests_.scalar_pairs += tally.overlap_tests.scalar_pairs;
}

template <int Dim>
void Sampler<Dim>::tune() {
  constexpr std::uint64_t enough = 100;  // acceptance to about 0.05
  state_.translation.tune(enough, 0.5 * configuration_.box.lengths().minCoeff());
  state_.rotation.tune(enough, std::numbers::pi / 2);
}

template class Sampler<2>;
template class Sampler<3>;

}  // namespace vitrel
