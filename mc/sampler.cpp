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

#include "core/contact/ellipse_gap.h"
#include "core/parallel.h"
#include "mc/hard_core.h"
#include "mc/trial.h"

namespace vitrel {

namespace {

/// Maximum distance of centres at which `reshape` must test.
double reach_of(double largest, double margin) {
  return 2 * (largest + margin);
}

}  // namespace

struct Sampler::DomainContext {
  std::size_t domain;
  SimdCells::FreeList& free_list;
  Tally& tally;
};

Sampler::Sampler(Configuration2& configuration, std::uint64_t seed, const SweepState& state,
                 int threads)
    : configuration_(configuration),
      largest_(largest_circumradius(configuration)),
      threads_(threads),
      seed_(seed),
      state_(state) {
  axis_.reserve(configuration.size());
  for (double angle : configuration.angle) axis_.push_back(axis_at(angle));
  fit_box();
}

void Sampler::fit_box() {
  margin_ = hard_margin(configuration_);
  half_box_ = 0.5 * configuration_.box.lengths();
  shortest_side_ = configuration_.box.lengths().minCoeff();
  fit_board();
}

void Sampler::fit_board() {
  board_.emplace(configuration_.box, reach_of(largest_, margin_), configuration_.size());
  arrange();
}

void Sampler::set_steps(double translation, double rotation) {
  state_.translation.size = translation;
  state_.rotation.size = rotation;
}

void Sampler::sweep() {
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
void Sampler::arrange() {
  const std::size_t n = configuration_.size();
  order_.resize(n);
  cell_of_.resize(n);
  begin_.assign(board_->cells(), 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t cell = board_->index(board_->cell_of(configuration_.position[i]));
    cell_of_[i] = static_cast<SimdCells::Index>(cell);
    ++begin_[cell];
  }
  domain_begin_.clear();
  SimdCells::Index before = 0;
  for (std::size_t domain = 0; domain < board_->domains(); ++domain) {
    domain_begin_.push_back(before);
    board_->for_each_cell(domain,
                          [&](std::size_t cell) { before += std::exchange(begin_[cell], before); });
  }
  domain_begin_.push_back(before);
  for (std::size_t i = 0; i < n; ++i)
    order_[begin_[cell_of_[i]]++] = static_cast<SimdCells::Index>(i);

  cells_.resize(board_->cells(), n);
  free_lists_.assign(board_->domains(), SimdCells::FreeList(SimdCells::none));
  in_parallel(board_->domains(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t domain = begin; domain < end; ++domain) fill_domain(domain);
  });
}

void Sampler::fill_domain(std::size_t domain) {
  board_->for_each_cell(domain, [&](std::size_t cell) { cells_.clear(cell); });
  const std::size_t begin = domain_begin_[domain], end = domain_begin_[domain + 1];
  free_lists_[domain] = cells_.free_groups(begin, end);
  for (std::size_t k = begin; k < end; ++k) {
    const std::size_t i = order_[k];
    cells_.insert(i, cell_of_[i], configuration_.shape[i], configuration_.position[i], axis_[i],
                  free_lists_[domain]);
  }
}

void Sampler::sweep_domains(const std::vector<std::size_t>& domains) {
  std::mutex adding;
  in_parallel(domains.size(), threads_, [&](std::size_t begin, std::size_t end) {
    Tally mine;
    for (std::size_t k = begin; k < end; ++k) sweep_domain(domains[k], mine);
    const std::lock_guard lock(adding);
    add(mine);
  });
}

void Sampler::sweep_domain(std::size_t domain, Tally& tally) {
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
      const bool is_round = cells_.group_of(i).shape(cells_.lane_of(i)).is_round();
      if (!is_round && (words[3] & 1) == 1)
        rotate(i, words, context);
      else
        translate(i, words, context);
    }
  }
}

void Sampler::translate(std::size_t i, const Words& words, DomainContext& context) {
  SimdCells::Group& group = cells_.group_of(i);
  const int lane = cells_.lane_of(i);
  const Vec2 step(plus_minus_one(words[1]), plus_minus_one(words[2]));
  Vec2 position = group.position(lane) + state_.translation.size * step;
  Shift<2> crossed = Shift<2>::Zero();
  if (((position.array().abs() >= half_box_.array())).any())
    configuration_.box.wrap(position, crossed);
  ++context.tally.counts.translations_tried;
  const Checkerboard::Cell cell = board_->cell_of(position);
  if (board_->domain_of(cell) != context.domain) return;
  // Own images move along: their distances stay whole box lengths.
  const Ellipse shape = group.shape(lane);
  const Vec2 axis = group.axis(lane);
  if (!clear_of_others(i, OverlapBatch(shape, axis, margin_), position, cell,
                       context.tally.overlap_tests))
    return;
  ++context.tally.counts.translations_accepted;
  configuration_.position[i] = position;
  configuration_.image[i] += crossed;
  if (group.cell == board_->index(cell)) {
    group.x[lane] = position.x();
    group.y[lane] = position.y();
  } else {
    cells_.remove(i, context.free_list);
    cells_.insert(i, board_->index(cell), shape, position, axis, context.free_list);
  }
}

void Sampler::rotate(std::size_t i, const Words& words, DomainContext& context) {
  SimdCells::Group& group = cells_.group_of(i);
  const int lane = cells_.lane_of(i);
  const double angle = configuration_.angle[i] + state_.rotation.size * plus_minus_one(words[1]);
  const Vec2 axis = axis_at(angle), position = group.position(lane);
  const Ellipse shape = group.shape(lane);
  ++context.tally.counts.rotations_tried;
  if (!clear_of_others(i, OverlapBatch(shape, axis, margin_), position, board_->cell_of(position),
                       context.tally.overlap_tests) ||
      !clear_of_itself(shape, axis, margin_))
    return;
  ++context.tally.counts.rotations_accepted;
  configuration_.angle[i] = angle;
  axis_[i] = axis;
  group.ux[lane] = axis.x();
  group.uy[lane] = axis.y();
}

void Sampler::exchange(std::size_t i, std::size_t j, DomainContext& context) {
  const Ellipse shape_i = configuration_.shape[i], shape_j = configuration_.shape[j];
  if (shape_i.a == shape_j.a && shape_i.b == shape_j.b) return;
  ++context.tally.counts.exchanges_tried;
  cells_.exchange(i, j);
  const bool i_is_larger = shape_i.volume() > shape_j.volume();
  if (!fits(i_is_larger ? i : j, context.tally.overlap_tests) ||
      !fits(i_is_larger ? j : i, context.tally.overlap_tests)) {
    cells_.exchange(i, j);
    return;
  }
  ++context.tally.counts.exchanges_accepted;
  std::swap(configuration_.position[i], configuration_.position[j]);
  std::swap(configuration_.image[i], configuration_.image[j]);
  std::swap(configuration_.angle[i], configuration_.angle[j]);
  std::swap(axis_[i], axis_[j]);
}

// Whether particle i keeps the margin at its current place in the cells.
bool Sampler::fits(std::size_t i, OverlapTestCounts& tests) const {
  const SimdCells::Group& group = cells_[cells_.group_index(i)];
  const int lane = cells_.lane_of(i);
  const Ellipse shape = group.shape(lane);
  const Vec2 axis = group.axis(lane), position = group.position(lane);
  return clear_of_others(i, OverlapBatch(shape, axis, margin_), position, board_->cell_of(position),
                         tests) &&
         clear_of_itself(shape, axis, margin_);
}

bool Sampler::reshape(std::size_t i, const Ellipse& shape) {
  if (shape.circumradius() > largest_) {
    largest_ = shape.circumradius();
    fit_board();
  }
  const double margin = 2 * margin_;
  const Vec2 position = configuration_.position[i];
  if (!clear_of_others(i, OverlapBatch(shape, axis_[i], margin), position,
                       board_->cell_of(position), overlap_tests_) ||
      !clear_of_itself(shape, axis_[i], margin))
    return false;
  configuration_.shape[i] = shape;
  cells_.group_of(i).set(cells_.lane_of(i), shape, position, axis_[i]);
  return true;
}

bool Sampler::rescale(const Vec2& factors) {
  const PeriodicBox<2> box = configuration_.box;
  const std::vector<Vec2> position = configuration_.position;
  const std::vector<Shift<2>> image = configuration_.image;
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
bool Sampler::is_hard() {
  std::atomic<bool> hard = true;
  std::mutex adding;
  in_parallel(order_.size(), threads_, [&](std::size_t begin, std::size_t end) {
    OverlapTestCounts mine;
    for (std::size_t k = begin; k < end && hard; ++k) {
      const std::size_t i = order_[k];
      const Ellipse& shape = configuration_.shape[i];
      const Vec2& position = configuration_.position[i];
      if (!clear_of_others(i, OverlapBatch(shape, axis_[i], margin_), position,
                           board_->cell_of(position), mine) ||
          !clear_of_itself(shape, axis_[i], margin_))
        hard = false;
    }
    const std::lock_guard lock(adding);
    overlap_tests_.batches += mine.batches;
    overlap_tests_.scalar_pairs += mine.scalar_pairs;
  });
  return hard;
}

bool Sampler::clear_of_others(std::size_t i, const OverlapBatch& batch, const Vec2& position,
                              const Checkerboard::Cell& cell, OverlapTestCounts& tests) const {
  return vitrel::clear_of_others(*board_, cells_, i, batch, position, cell, tests);
}

bool Sampler::clear_of_itself(const Ellipse& shape, const Vec2& axis, double margin) const {
  return shortest_side_ >= 2 * shape.circumradius() + margin ||
         clear_of_periodic_images(configuration_.box, shape, axis, margin);
}

void Sampler::add(const Tally& tally) {
  const TrialCounts& more = tally.counts;
  state_.counts.add(more);
  state_.translation.count(more.translations_tried, more.translations_accepted);
  state_.rotation.count(more.rotations_tried, more.rotations_accepted);
  overlap_tests_.batches += tally.overlap_tests.batches;
  overlap_tests_.scalar_pairs += tally.overlap_tests.scalar_pairs;
}

void Sampler::tune() {
  constexpr std::uint64_t enough = 100;  // acceptance to about 0.05
  state_.translation.tune(enough, 0.5 * configuration_.box.lengths().minCoeff());
  state_.rotation.tune(enough, std::numbers::pi / 2);
}

}  // namespace vitrel
