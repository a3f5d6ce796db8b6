#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/elementary.h"
#include "core/geometry/periodic_box.h"

namespace vitrel {

/// A cell list for points in a periodic box.
///
/// A query visits the cells that its reach covers in unwrapped cell coordinates. A cell outside the box is the image of
/// one inside, and the number of boxes between them is the shift. Each image (j, shift) within reach is therefore found
/// exactly once, in boxes of any size, down to a single cell. Insert and move cost O(1).
template <int Dim>
class CellGrid {
 public:
  /// Makes cells for about `particles` points and queries of about `reach`.
  CellGrid(const PeriodicBox<Dim>& box, double reach, std::size_t particles) : box_(box) {
    constexpr double cells_per_particle = 4;
    const double max_count = std::ceil(root(cells_per_particle * particles, Dim)) + 1;
    std::int64_t cells = 1;
    for (int k = 0; k < Dim; ++k) {
      const double target = box.lengths()[k] / (0.5 * reach);
      count_[k] = static_cast<std::int64_t>(std::clamp(target, 1.0, max_count));
      width_[k] = box.lengths()[k] / static_cast<double>(count_[k]);
      cells *= count_[k];
    }
    first_.assign(static_cast<std::size_t>(cells), none);
    points_.reserve(particles);
  }

  /// Adds point i, wrapped into the box. Points are numbered 0, 1, 2 …
  void insert(std::size_t i, const Vec<Dim>& position) {
    if (points_.size() <= i) points_.resize(i + 1);
    points_[i].position = position;
    enter(static_cast<Index>(i), cell_of(position));
  }

  void move(std::size_t i, const Vec<Dim>& position) {
    const std::size_t from = cell_of(points_[i].position), to = cell_of(position);
    if (from != to) leave(static_cast<Index>(i), from);
    points_[i].position = position;
    if (from != to) enter(static_cast<Index>(i), to);
  }

  std::size_t size() const { return points_.size(); }
  const Vec<Dim>& operator[](std::size_t i) const { return points_[i].position; }

  /// Calls visit(j, shift, separation) for every image r_j + shift ∘ L within `reach` of `position`, which may lie
  /// outside the box; separation = r_j + shift ∘ L − position. A point at `position` itself is among them. A visit that
  /// returns false ends the query. Returns whether all images were visited.
  template <class Visit>
  bool for_each_near(const Vec<Dim>& position, double reach, Visit&& visit) const {
    return for_each_cell(position, reach, [&](std::size_t cell, const Shift<Dim>& shift) {
      const Vec<Dim> offset = box_.translation(shift) - position;
      for (Index j = first_[cell]; j != none; j = points_[j].next) {
        const Vec<Dim> separation = points_[j].position + offset;
        if (squared_norm(separation) > reach * reach) continue;
        if (!goes_on(visit, static_cast<std::size_t>(j), shift, separation)) return false;
      }
      return true;
    });
  }

 private:
  using Index = std::uint32_t;
  static constexpr Index none = std::numeric_limits<Index>::max();
  struct Point {
    Vec<Dim> position;
    Index next = none;  // the next point in the cell
  };
  struct Range {
    std::int64_t low, high;
  };

  template <class Visit>
  static bool goes_on(Visit& visit, std::size_t j, const Shift<Dim>& shift,
                      const Vec<Dim>& separation) {
    if constexpr (std::is_same_v<
                      std::invoke_result_t<Visit&, std::size_t, const Shift<Dim>&, const Vec<Dim>&>,
                      bool>) {
      return visit(j, shift, separation);
    } else {
      visit(j, shift, separation);
      return true;
    }
  }

  // Calls visit(cell, shift) for the cells within reach, until one call returns false.
  template <class Visit>
  bool for_each_cell(const Vec<Dim>& position, double reach, Visit&& visit) const {
    Range ranges[Dim];
    for (int k = 0; k < Dim; ++k) ranges[k] = covered(position, reach, k);
    Shift<Dim> shift;
    return walk<0>(ranges, 0, shift, visit);
  }

  // Visits the cells within `ranges` in direction k and later directions; `before` is the cell number from the
  // directions before k.
  template <int k, class Visit>
  bool walk(const Range (&ranges)[Dim], std::int64_t before, Shift<Dim>& shift,
            Visit& visit) const {
    for (std::int64_t c = ranges[k].low; c <= ranges[k].high; ++c) {
      shift[k] = boxes_off(c, k);
      const std::int64_t cell = before * count_[k] + c - shift[k] * count_[k];
      if constexpr (k + 1 < Dim) {
        if (!walk<k + 1>(ranges, cell, shift, visit)) return false;
      } else {
        if (!visit(static_cast<std::size_t>(cell), shift)) return false;
      }
    }
    return true;
  }

  // Returns how many boxes a cell lies beyond the first.
  std::int32_t boxes_off(std::int64_t cell, int k) const {
    std::int32_t boxes = 0;
    for (; cell < 0; cell += count_[k]) --boxes;
    for (; cell >= count_[k]; cell -= count_[k]) ++boxes;
    return boxes;
  }

  // Returns the cells that [position − reach, position + reach] covers, with a margin for rounding at the edges.
  Range covered(const Vec<Dim>& position, double reach, int k) const {
    const double centre = position[k] + 0.5 * box_.lengths()[k];
    const double half = reach + 1e-12 * (reach + box_.lengths()[k]);
    return {static_cast<std::int64_t>(std::floor((centre - half) / width_[k])),
            static_cast<std::int64_t>(std::floor((centre + half) / width_[k]))};
  }

  std::size_t cell_of(const Vec<Dim>& position) const {
    std::int64_t cell = 0;
    for (int k = 0; k < Dim; ++k) {
      const auto at =
          static_cast<std::int64_t>((position[k] + 0.5 * box_.lengths()[k]) / width_[k]);
      cell = cell * count_[k] + std::clamp<std::int64_t>(at, 0, count_[k] - 1);
    }
    return static_cast<std::size_t>(cell);
  }

  void enter(Index i, std::size_t cell) {
    points_[i].next = first_[cell];
    first_[cell] = i;
  }

  void leave(Index i, std::size_t cell) {
    Index* link = &first_[cell];
    while (*link != i) link = &points_[*link].next;
    *link = points_[i].next;
  }

  PeriodicBox<Dim> box_;
  std::int64_t count_[Dim];
  double width_[Dim];
  std::vector<Index> first_;  // first point of every cell, the last direction fastest
  std::vector<Point> points_;
};

}  // namespace vitrel
