#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/elementary.h"
#include "core/geometry/periodic_box.h"
#include "core/large_vector.h"
#include "core/neighbors/list_pool.h"
#include "core/neighbors/neighbor.h"

namespace vitrel {

/// Returns the minimum width of the cells of CellNeighbors. The excess over the largest diameter covers rounding: a
/// position may be outside its cell by CellNeighbors::slack.
constexpr double min_cell_width(double max_radius) {
  return 2.2 * max_radius;
}

/// Returns whether a box holds the cells of CellNeighbors, of which there must be three in each direction.
template <int Dim>
bool cells_fit(const PeriodicBox<Dim>& box, double max_radius) {
  return box.lengths().minCoeff() >= 3 * min_cell_width(max_radius);
}

/// Neighbours without lists, for gases of disks and spheres: the neighbours of a particle are the other particles in
/// its own cell and in the 3^D − 1 cells around it.
///
/// A particle changes its cell when its centre reaches a wall, and gains the particles in the 3^(D−1) cells ahead;
/// nothing is stored per pair. In a gas a particle changes its neighbours many times between two collisions, and
/// updating lists would cost more (docs/studies/engine.md).
template <Body B>
class CellNeighbors {
  static constexpr int dimension = B::dimension;
  using Vector = Vec<dimension>;

 public:
  /// `positions` are wrapped into the box, which must hold the cells (cells_fit).
  CellNeighbors(const PeriodicBox<dimension>& box, double max_radius,
                std::span<const Vector> positions)
      : lower_(-0.5 * box.lengths()) {
    assert(cells_fit(box, max_radius));
    const double volume = particles_per_cell * box.volume() / static_cast<double>(positions.size());
    const double width = std::max(min_cell_width(max_radius), root(volume, dimension));
    std::size_t cells = 1;
    for (int k = 0; k < dimension; ++k) {
      count_[k] = std::max(3, static_cast<std::int32_t>(box.lengths()[k] / width));
      width_[k] = box.lengths()[k] / count_[k];
      stride_[k] = cells;
      cells *= static_cast<std::size_t>(count_[k]);
    }
    std::vector<std::uint32_t> counts(cells);
    cell_.reserve(positions.size());
    for (const Vector& position : positions) {
      cell_.push_back(cell_at(position));
      ++counts[number(cell_.back())];
    }
    contents_.reserve(counts);
    for (std::uint32_t i = 0; i < cell_.size(); ++i) contents_.add(number(cell_[i]), i);
  }

  /// Returns the neighbours of particle i. The span is valid until the next call in the same thread.
  std::span<Neighbor<B>> of(std::size_t i) const {
    Cell first, last;
    for (int k = 0; k < dimension; ++k) first[k] = cell_[i][k] - 1, last[k] = cell_[i][k] + 1;
    return collect(i, first, last);
  }

  /// Returns the time until the centre of particle i reaches a wall of its cell; 0 if it is outside.
  double exit_time(std::size_t i, const Vector& position, const Vector& velocity) const {
    return std::max(next_wall(i, position, velocity).time, 0.0);
  }

  /// The result of crossing a wall: the neighbours that the particle gains, and the boxes that it leaves.
  struct Crossing {
    std::span<Neighbor<B>> gained;  ///< valid until the next call in the same thread
    Shift<dimension> boxes;         ///< boxes left: the position decreases by boxes ∘ L
  };
  /// Moves particle i to the cell behind the wall that it has reached.
  Crossing cross(std::size_t i, const Vector& position, const Vector& velocity) {
    const auto [time, k, step] = next_wall(i, position, velocity);
    Cell& cell = cell_[i];
    contents_.remove_if(number(cell), [i](std::uint32_t j) { return j == i; });
    Crossing crossing{{}, Shift<dimension>::Zero()};
    cell[k] = wrapped(cell[k] + step, k, crossing.boxes[k]);
    contents_.add(number(cell), static_cast<std::uint32_t>(i));
    Cell first, last;
    for (int m = 0; m < dimension; ++m) first[m] = cell[m] - 1, last[m] = cell[m] + 1;
    first[k] = last[k] = cell[k] + step;
    crossing.gained = collect(i, first, last);
    return crossing;
  }

 private:
  /// More particles per cell mean fewer crossings but more predictions.
  static constexpr double particles_per_cell = dimension == 2 ? 1 : 0.5;
  using Cell = std::array<std::int32_t, dimension>;
  /// A position that is outside its cell by more than this fraction of the width was not reached in flight, but by a
  /// displacement.
  static constexpr double slack = 1e-6;
  struct Wall {
    double time = std::numeric_limits<double>::infinity();
    int direction = 0;
    std::int32_t step = 0;  // step to the cell behind the wall
  };

  Cell cell_at(const Vector& position) const {
    Cell cell;
    for (int k = 0; k < dimension; ++k)
      cell[k] = std::clamp(static_cast<std::int32_t>((position[k] - lower_[k]) / width_[k]), 0,
                           count_[k] - 1);
    return cell;
  }
  std::size_t number(const Cell& cell) const {
    std::size_t sum = 0;
    for (int k = 0; k < dimension; ++k) sum += static_cast<std::size_t>(cell[k]) * stride_[k];
    return sum;
  }
  // Returns the coordinate of the cell in the box; `boxes` becomes the number of boxes between it and the given cell.
  std::int32_t wrapped(std::int32_t at, int k, std::int32_t& boxes) const {
    boxes = at < 0 ? -1 : (at >= count_[k] ? 1 : 0);
    return at - boxes * count_[k];
  }

  Wall next_wall(std::size_t i, const Vector& position, const Vector& velocity) const {
    Wall next;
    for (int k = 0; k < dimension; ++k) {
      const double inside = position[k] - (lower_[k] + width_[k] * cell_[i][k]);
      if (inside < -slack * width_[k]) return {0, k, -1};
      if (inside > (1 + slack) * width_[k]) return {0, k, 1};
      if (velocity[k] == 0) continue;
      const bool rises = velocity[k] > 0;
      const double time = ((rises ? width_[k] : 0) - inside) / velocity[k];
      if (time < next.time) next = {time, k, rises ? 1 : -1};
    }
    return next;
  }

  // Returns the particles of the cells from `first` to `last`, without i itself.
  std::span<Neighbor<B>> collect(std::size_t i, const Cell& first, const Cell& last) const {
    static thread_local std::vector<Neighbor<B>> found;
    found.clear();
    Neighbor<B> of_cell;
    for_each_cell<dimension - 1>(first, last, 0, of_cell, [&](std::size_t cell) {
      for (const std::uint32_t j : contents_[cell]) {
        if (j == i) continue;
        found.push_back(of_cell);
        found.back().other = j;
      }
    });
    return found;
  }

  // Calls visit(cell) for the cells in directions 0 … k, and sets their boxes in `of_cell`.
  template <int k, class Visit>
  void for_each_cell(const Cell& first, const Cell& last, std::size_t base, Neighbor<B>& of_cell,
                     Visit&& visit) const {
    for (std::int32_t at = first[k]; at <= last[k]; ++at) {
      std::int32_t boxes;
      const std::size_t cell = base + static_cast<std::size_t>(wrapped(at, k, boxes)) * stride_[k];
      // The boxes are stored only when they change, which is rare, because a store here would delay the copies.
      if (of_cell.boxes[k] != boxes) of_cell.boxes[k] = static_cast<std::int16_t>(boxes);
      if constexpr (k == 0)
        visit(cell);
      else
        for_each_cell<k - 1>(first, last, cell, of_cell, visit);
    }
  }

  Vector lower_;  // corner of the box
  Cell count_;    // number of cells
  std::array<std::size_t, dimension> stride_;
  Vector width_;
  LargeVector<Cell> cell_;            // cell of each particle
  ListPool<std::uint32_t> contents_;  // particles of each cell
};

}  // namespace vitrel
