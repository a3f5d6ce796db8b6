#include "mc/hard_particles.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <utility>

#include "core/parallel.h"
#include "core/special_values.h"
#include "mc/hard_core.h"

namespace vitrel {

namespace {

void swap_orientations(OrientedEllipse& one, OrientedEllipse& two) {
  std::swap(one.axis, two.axis);
}
void swap_orientations(OrientedEllipsoid& one, OrientedEllipsoid& two) {
  if (one.shape.is_round() &&
      two.shape.is_round()) {  // orientations do not change their shape matrices
    std::swap(one.orientation, two.orientation);
    return;
  }
  const Quaternion of_one = one.orientation;
  one = {one.shape, two.orientation};
  two = {two.shape, of_one};
}

template <int Dim>
double smallest_inradius(const Configuration<Dim>& configuration) {
  double smallest = configuration.shape.front().inradius();
  for (const ParticleShape<Dim>& shape : configuration.shape)
    smallest = std::min(smallest, shape.inradius());
  return smallest;
}

}  // namespace

template <int Dim>
HardParticles<Dim>::HardParticles(Configuration<Dim>& configuration)
    : configuration_(configuration),
      smallest_(smallest_inradius(configuration)),
      largest_(largest_circumradius(configuration)),
      bodies_(oriented_bodies(configuration)) {
  fit_box();
}

template <int Dim>
void HardParticles<Dim>::fit_box() {
  margin_ = hard_margin(configuration_);
  half_box_ = 0.5 * configuration_.box.lengths();
  shortest_side_ = configuration_.box.lengths().minCoeff();
  fit_board();
}

/// Cells are as wide as the maximum distance of centres at which two particles must be tested, 2 (a + margin), or at
/// which a chain may stop (ellipse_free_path_batch.h, ellipsoid_free_path_batch.h), which is more.
template <int Dim>
void HardParticles<Dim>::fit_board() {
  const double enlarged = 1 + 2 * contact_margins * margin_ / smallest_;
  board_.emplace(configuration_.box, 2 * enlarged * largest_, configuration_.size());
  arrange_by_domain(1);
}

template <int Dim>
void HardParticles<Dim>::arrange() {
  cells_.resize(board_->cells(), configuration_.size());
  for (std::size_t cell = 0; cell < board_->cells(); ++cell) cells_.clear(cell);
  free_lists_.assign(1, cells_.free_groups(0, configuration_.size()));
  for (std::size_t i = 0; i < configuration_.size(); ++i) {
    const Vec<Dim>& position = configuration_.position[i];
    cells_.insert(i, board_->index(board_->cell_of(position)), bodies_[i], position,
                  free_lists_.front());
  }
}

template <int Dim>
void HardParticles<Dim>::arrange_by_domain(int threads) {
  sort();
  cells_.resize(board_->cells(), configuration_.size());
  free_lists_.assign(board_->domains(), FreeList(Cells::none));
  each_in_parallel(board_->domains(), threads, [&](std::size_t domain) { fill_domain(domain); });
}

// Counting sort of all particles into the cells.
template <int Dim>
void HardParticles<Dim>::sort() {
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

template <int Dim>
void HardParticles<Dim>::fill_domain(std::size_t domain) {
  board_->for_each_cell(domain, [&](std::size_t cell) { cells_.clear(cell); });
  free_lists_[domain] = cells_.free_groups(domain_begin_[domain], domain_begin_[domain + 1]);
  for (const std::size_t i : members(domain)) {
    // It may have shrunk.
    if (bodies_[i].shape != configuration_.shape[i])
      bodies_[i] = oriented(configuration_.shape[i], orientations(configuration_)[i]);
    cells_.insert(i, cell_of_[i], bodies_[i], configuration_.position[i], free_lists_[domain]);
  }
}

template <int Dim>
bool HardParticles<Dim>::is_clear_as(std::size_t i, const Body& body, double margin,
                                     OverlapTestCounts& tests) const {
  const Vec<Dim>& position = configuration_.position[i];
  const bool clear_of_itself =
      shortest_side_ >= 2 * body.shape.circumradius() + margin ||
      clear_of_periodic_images(configuration_.box, body.shape, axes_of(body), margin);
  return clear_of_itself && clear_of_others(*board_, cells_, i, body, bodies_, margin, position,
                                            board_->cell_of(position), tests);
}

template <int Dim>
double HardParticles<Dim>::free_radius(std::size_t i) const {
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

// Whether particle i keeps the margin where it is.
template <int Dim>
bool HardParticles<Dim>::fits(std::size_t i, OverlapTestCounts& tests) const {
  return is_clear_as(i, bodies_[i], margin_, tests);
}

template <int Dim>
bool HardParticles<Dim>::try_turn(std::size_t i, const Vec<Dim>& turn, OverlapTestCounts& tests) {
  Orientation<Dim>& orientation = orientations(configuration_)[i];
  const Orientation<Dim> trial = rotated(configuration_.shape[i], orientation, turn);
  const Body body = oriented(configuration_.shape[i], trial);
  if (!is_clear_as(i, body, margin_, tests)) return false;
  orientation = trial;
  bodies_[i] = body;
  cells_.group_of(i).turn(cells_.lane_of(i), body);
  return true;
}

template <int Dim>
bool HardParticles<Dim>::try_exchange(std::size_t i, std::size_t j, OverlapTestCounts& tests) {
  exchange(i, j);
  const bool i_is_larger = configuration_.shape[i].volume() > configuration_.shape[j].volume();
  if (fits(i_is_larger ? i : j, tests) && fits(i_is_larger ? j : i, tests)) return true;
  exchange(i, j);
  return false;
}

template <int Dim>
void HardParticles<Dim>::exchange(std::size_t i, std::size_t j) {
  cells_.exchange(i, j);
  std::swap(configuration_.position[i], configuration_.position[j]);
  std::swap(configuration_.image[i], configuration_.image[j]);
  auto& orientation = orientations(configuration_);
  std::swap(orientation[i], orientation[j]);
  swap_orientations(bodies_[i], bodies_[j]);
}

template <int Dim>
bool HardParticles<Dim>::try_reshape(std::size_t i, const ParticleShape<Dim>& shape,
                                     OverlapTestCounts& tests) {
  if (shape.circumradius() > largest_) {
    largest_ = shape.circumradius();
    fit_board();
  }
  const Body body = oriented(shape, orientations(configuration_)[i]);
  if (!is_clear_as(i, body, 2 * margin_, tests)) return false;
  configuration_.shape[i] = shape;
  bodies_[i] = body;
  cells_.group_of(i).set(cells_.lane_of(i), body, configuration_.position[i]);
  return true;
}

template <int Dim>
bool HardParticles<Dim>::try_rescale(const Vec<Dim>& factors, int threads,
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

template <int Dim>
bool HardParticles<Dim>::is_hard(int threads, OverlapTestCounts& tests) const {
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

template class HardParticles<2>;
template class HardParticles<3>;

}  // namespace vitrel
