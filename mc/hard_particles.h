#pragma once

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/special_values.h"
#include "core/state/configuration.h"
#include "mc/checkerboard.h"
#include "mc/hard_core.h"
#include "mc/simd_cells.h"
#include "mc/sweep_state.h"
#include "mc/trial.h"

namespace vitrel {

/// The particles of a configuration, sorted into the cells of a checkerboard, and the moves that change them. A move is
/// made if all particles then keep the hard-core margin (hard_core.h) to each other; otherwise it leaves everything as
/// it is. A caller that proposes moves with the right probabilities samples hard states.
///
/// Cells have no capacity limit. Overlaps are decided by proofs (ellipse_overlap_batch.h, ellipsoid_overlap_batch.h,
/// pair_overlaps.h) that depend on the state only, to the rounding of the margin.
///
/// `Shape` is constructed from the shape of the configuration, and has the same radii, roundness and `fits_into`; its
/// overlaps and free paths are its own (resting_bodies.h).
template <class Shape>
class HardParticles {
 public:
  static constexpr int Dim = Shape::dimension;
  using Bodies = RestingBodies<Shape>;
  using Body = typename Bodies::Body;
  using Cells = SimdCells<typename Bodies::Batch>;
  using Cell = typename Checkerboard<Dim>::Cell;
  using Index = typename Cells::Index;
  using FreeList = typename Cells::FreeList;

  /// Gap at which event chains stop, in margins. It exceeds one margin so far that rounding does not matter.
  static constexpr double contact_margins = 1.25;

  /// The configuration must be hard, with wrapped positions, and outlive this object. As long as this object is used,
  /// nothing else may move particles, or change shapes except to smaller ones.
  explicit HardParticles(Configuration<Dim>& configuration);

  /// Sorts all particles into cells, in the order of their numbers. Shapes must not have shrunk since construction.
  void arrange();
  /// Sorts all particles into cells on this number of threads, with free groups for each domain: particles then may not
  /// leave their domain.
  void arrange_by_domain(int threads);

  Configuration<Dim>& configuration() { return configuration_; }
  const Configuration<Dim>& configuration() const { return configuration_; }
  Checkerboard<Dim>& board() { return *board_; }
  const Checkerboard<Dim>& board() const { return *board_; }
  Cells& cells() { return cells_; }
  const Cells& cells() const { return cells_; }
  const std::vector<Body>& bodies() const { return bodies_; }
  double margin() const { return margin_; }
  /// Returns the largest semi-axis of all particles.
  double largest() const { return largest_; }
  const Vec<Dim>& half_box() const { return half_box_; }
  /// Returns the particles that a domain held when they were arranged by domain.
  std::span<const Index> members(std::size_t domain) const {
    return {order_.data() + domain_begin_[domain], order_.data() + domain_begin_[domain + 1]};
  }
  /// Returns the free groups of a domain; after `arrange`, list 0 holds those of all domains.
  FreeList& free_list(std::size_t domain) { return free_lists_[domain]; }

  /// Returns the body of particle i from where it is read fastest.
  decltype(auto) body_of(std::size_t i) const {
    if constexpr (requires(const typename Bodies::Batch batch) { batch.body(0); })
      return cells_[cells_.group_index(i)].body(cells_.lane_of(i));
    else
      return (bodies_[i]);
  }

  /// Returns whether particle i keeps the margin to all others at this position in this cell. Its own images move
  /// along.
  VITREL_INLINE bool is_clear_at(std::size_t i, const Vec<Dim>& position, const Cell& cell,
                                 OverlapTestCounts& tests) const {
    return clear_of_others<Shape>(*board_, cells_, i, body_of(i), bodies_, margin_, position, cell,
                                  tests);
  }
  /// Returns whether particle i, where it is but with this body, keeps this margin to all others and its own images.
  bool is_clear_as(std::size_t i, const Body& body, double margin, OverlapTestCounts& tests) const;

  /// Returns the largest radius, to rounding, with which particle i keeps the margin where it is. All particles must be
  /// round.
  double free_radius(std::size_t i) const;

  /// Moves particle i to a wrapped position in this cell; `crossed` counts how often it has crossed the borders of the
  /// box.
  void move(std::size_t i, const Vec<Dim>& position, const Shift<Dim>& crossed, std::size_t cell,
            FreeList& free_list) {
    configuration_.position[i] = position;
    configuration_.image[i] += crossed;
    if (auto& group = cells_.group_of(i); group.cell == cell)
      group.move(cells_.lane_of(i), position);
    else
      change_cell(i, position, cell, free_list);
  }
  /// Turns particle i by an angle (the first component of `turn`) or, in space, by a vector in its own frame.
  bool try_turn(std::size_t i, const Vec<Dim>& turn, OverlapTestCounts& tests);
  /// Exchanges the positions and orientations of particles i and j, which must be of one domain if there are domains.
  bool try_exchange(std::size_t i, std::size_t j, OverlapTestCounts& tests);
  /// Exchanges the positions and orientations of particles i and j without a test.
  void exchange(std::size_t i, std::size_t j);
  /// Replaces the shape of particle i if it then keeps twice the margin to all others. The factor of two ensures that a
  /// later scaling of all lengths keeps the margin in spite of rounding.
  bool try_reshape(std::size_t i, const ParticleShape<Dim>& shape, OverlapTestCounts& tests);
  /// Scales the sides of the box and all positions by these factors; shapes and orientations stay. Tests every pair
  /// twice, on this number of threads.
  bool try_rescale(const Vec<Dim>& factors, int threads, OverlapTestCounts& tests);

 private:
  void sort();
  void fill_domain(std::size_t domain);
  void fit_box();
  void fit_board();
  void change_cell(std::size_t i, const Vec<Dim>& position, std::size_t cell, FreeList& free_list) {
    const Body body = body_of(i);
    cells_.remove(i, free_list);
    cells_.insert(i, cell, body, position, free_list);
  }
  bool fits(std::size_t i, OverlapTestCounts& tests) const;
  bool is_hard(int threads, OverlapTestCounts& tests) const;

  Configuration<Dim>& configuration_;
  const double smallest_;  // smallest inradius
  double largest_, margin_;
  Vec<Dim> half_box_;
  double shortest_side_;
  std::vector<Body> bodies_;
  std::optional<Checkerboard<Dim>> board_;
  Cells cells_;
  std::vector<Index> order_;               // particles, domain by domain and cell by cell
  std::vector<Index> cell_of_;             // cell of every particle, while sorting
  std::vector<Index> begin_;               // begin of every cell in order_, while sorting
  std::vector<std::size_t> domain_begin_;  // begin of every domain in order_
  std::vector<FreeList> free_lists_;       // one for every domain
};

template <int Dim>
HardParticles(Configuration<Dim>&) -> HardParticles<ParticleShape<Dim>>;

template <class Shape>
HardParticles<Shape>::HardParticles(Configuration<Dim>& configuration)
    : configuration_(configuration),
      smallest_(smallest_inradius(configuration)),
      largest_(largest_circumradius(configuration)),
      bodies_(resting_bodies<Shape>(configuration)) {
  fit_box();
}

template <class Shape>
void HardParticles<Shape>::fit_box() {
  margin_ = hard_margin(configuration_);
  half_box_ = 0.5 * configuration_.box.lengths();
  shortest_side_ = configuration_.box.lengths().minCoeff();
  fit_board();
}

/// Cells are as wide as the maximum distance of centres at which a chain may stop (ellipse_free_path_batch.h,
/// ellipsoid_free_path_batch.h). That is more than 2 (a + margin), the maximum distance at which two particles must be
/// tested.
template <class Shape>
void HardParticles<Shape>::fit_board() {
  const double enlarged = 1 + 2 * contact_margins * margin_ / smallest_;
  board_.emplace(configuration_.box, 2 * enlarged * largest_, configuration_.size());
  arrange_by_domain(1);
}

template <class Shape>
void HardParticles<Shape>::arrange() {
  cells_.resize(board_->cells(), configuration_.size());
  for (std::size_t cell = 0; cell < board_->cells(); ++cell) cells_.clear(cell);
  free_lists_.assign(1, cells_.free_groups(0, configuration_.size()));
  for (std::size_t i = 0; i < configuration_.size(); ++i) {
    const Vec<Dim>& position = configuration_.position[i];
    cells_.insert(i, board_->index(board_->cell_of(position)), bodies_[i], position,
                  free_lists_.front());
  }
}

template <class Shape>
void HardParticles<Shape>::arrange_by_domain(int threads) {
  sort();
  cells_.resize(board_->cells(), configuration_.size());
  free_lists_.assign(board_->domains(), FreeList(Cells::none));
  each_in_parallel(board_->domains(), threads, [&](std::size_t domain) { fill_domain(domain); });
}

// Sorts all particles into the cells by counting.
template <class Shape>
void HardParticles<Shape>::sort() {
  const std::size_t n = configuration_.size();
  order_.resize(n);
  cell_of_.resize(n);
  begin_.assign(board_->cells(), 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t cell = board_->index(board_->cell_of(configuration_.position[i]));
    cell_of_[i] = static_cast<Index>(cell);
    ++begin_[cell];
  }
  domain_begin_.clear();
  Index before = 0;
  for (std::size_t domain = 0; domain < board_->domains(); ++domain) {
    domain_begin_.push_back(before);
    board_->for_each_cell(domain,
                          [&](std::size_t cell) { before += std::exchange(begin_[cell], before); });
  }
  domain_begin_.push_back(before);
  for (std::size_t i = 0; i < n; ++i) order_[begin_[cell_of_[i]]++] = static_cast<Index>(i);
}

template <class Shape>
void HardParticles<Shape>::fill_domain(std::size_t domain) {
  board_->for_each_cell(domain, [&](std::size_t cell) { cells_.clear(cell); });
  free_lists_[domain] = cells_.free_groups(domain_begin_[domain], domain_begin_[domain + 1]);
  for (const std::size_t i : members(domain)) {
    // The particle may have shrunk.
    if (const Shape shape(configuration_.shape[i]); bodies_[i].shape != shape)
      bodies_[i] = Bodies::body(shape, orientations(configuration_)[i]);
    cells_.insert(i, cell_of_[i], bodies_[i], configuration_.position[i], free_lists_[domain]);
  }
}

template <class Shape>
VITREL_FLATTEN bool HardParticles<Shape>::is_clear_as(std::size_t i, const Body& body,
                                                      double margin,
                                                      OverlapTestCounts& tests) const {
  const Vec<Dim>& position = configuration_.position[i];
  const bool clear_of_itself = shortest_side_ >= 2 * body.shape.circumradius() + margin ||
                               clear_of_periodic_images(configuration_.box, body, margin);
  return clear_of_itself && clear_of_others<Shape>(*board_, cells_, i, body, bodies_, margin,
                                                   position, board_->cell_of(position), tests);
}

template <class Shape>
double HardParticles<Shape>::free_radius(std::size_t i) const {
  constexpr double rounded_down = 1 - 4 * std::numeric_limits<double>::epsilon();
  constexpr unsigned all = (1u << simd_width) - 1;
  const auto others = detail::all_lanes_but(cells_.lane_of(i));
  const Vec<Dim>& position = configuration_.position[i];
  SimdBatch least(infinity);
  for_each_near_group(*board_, cells_, i, position, board_->cell_of(position),
                      [&](const auto& group, const Vec<Dim>& offset, unsigned lanes) {
                        const SimdBatch distance = sqrt(group.squared_distances(offset));
                        const SimdBatch radius = rounded_down * distance - group.circumradii();
                        least =
                            min(least, lanes == all ? radius : select(others, radius, infinity));
                        return true;
                      });
  return std::min(hmin(least), 0.5 * shortest_side_) - margin_;
}

// Returns whether particle i keeps the margin where it is.
template <class Shape>
bool HardParticles<Shape>::fits(std::size_t i, OverlapTestCounts& tests) const {
  return is_clear_as(i, bodies_[i], margin_, tests);
}

template <class Shape>
bool HardParticles<Shape>::try_turn(std::size_t i, const Vec<Dim>& turn, OverlapTestCounts& tests) {
  Orientation<Dim>& orientation = orientations(configuration_)[i];
  const Orientation<Dim> trial = rotated(configuration_.shape[i], orientation, turn);
  const Body body = Bodies::body(Shape(configuration_.shape[i]), trial);
  if (!is_clear_as(i, body, margin_, tests)) return false;
  orientation = trial;
  bodies_[i] = body;
  cells_.group_of(i).turn(cells_.lane_of(i), body);
  return true;
}

template <class Shape>
bool HardParticles<Shape>::try_exchange(std::size_t i, std::size_t j, OverlapTestCounts& tests) {
  exchange(i, j);
  const bool i_is_larger = configuration_.shape[i].volume() > configuration_.shape[j].volume();
  if (fits(i_is_larger ? i : j, tests) && fits(i_is_larger ? j : i, tests)) return true;
  exchange(i, j);
  return false;
}

template <class Shape>
void HardParticles<Shape>::exchange(std::size_t i, std::size_t j) {
  cells_.exchange(i, j);
  std::swap(configuration_.position[i], configuration_.position[j]);
  std::swap(configuration_.image[i], configuration_.image[j]);
  auto& orientation = orientations(configuration_);
  std::swap(orientation[i], orientation[j]);
  swap_orientations(bodies_[i], bodies_[j]);
}

template <class Shape>
bool HardParticles<Shape>::try_reshape(std::size_t i, const ParticleShape<Dim>& shape,
                                       OverlapTestCounts& tests) {
  if (shape.circumradius() > largest_) {
    largest_ = shape.circumradius();
    fit_board();
  }
  const Body body = Bodies::body(Shape(shape), orientations(configuration_)[i]);
  if (!is_clear_as(i, body, 2 * margin_, tests)) return false;
  configuration_.shape[i] = shape;
  bodies_[i] = body;
  cells_.group_of(i).set(cells_.lane_of(i), body, configuration_.position[i]);
  return true;
}

template <class Shape>
bool HardParticles<Shape>::try_rescale(const Vec<Dim>& factors, int threads,
                                       OverlapTestCounts& tests) {
  const PeriodicBox<Dim> box = configuration_.box;
  const std::vector<Vec<Dim>> position = configuration_.position;
  const std::vector<Shift<Dim>> image = configuration_.image;
  scale_box(configuration_, factors);
  fit_box();
  if (is_hard(threads, tests)) return true;
  configuration_.box = box;
  configuration_.position = position;
  configuration_.image = image;
  fit_box();
  return false;
}

template <class Shape>
bool HardParticles<Shape>::is_hard(int threads, OverlapTestCounts& tests) const {
  std::atomic<bool> hard = true;
  std::mutex adding;
  in_parallel(order_.size(), threads, [&](std::size_t begin, std::size_t end) {
    OverlapTestCounts mine;
    for (std::size_t k = begin; k < end && hard; ++k) {
      if (!fits(order_[k], mine)) hard = false;
    }
    const std::lock_guard lock(adding);
    tests.add(mine);
  });
  return hard;
}

extern template class HardParticles<ParticleShape<2>>;
extern template class HardParticles<ParticleShape<3>>;

}  // namespace vitrel
