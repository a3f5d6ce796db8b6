#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/geometry/periodic_box.h"
#include "core/neighbors/ask_memory.h"

namespace vitrel {

/// A point of a cell grid. Other types can take its place that know more of a point and have these two:
/// whoever is near is then known with the one read that finds it.
struct CellPoint {
  Vec2 position;           // wrapped into the box
  std::uint32_t next = 0;  // the grid's own: the next point of the cell
};

/// Points in the cells of a periodic box, to find those near a place.
///
/// A query walks the cells that its reach covers in unwrapped cell coordinates; a cell beyond the
/// box is the image of one inside, and how many boxes lie between is the shift. So every image (j,
/// shift) within reach is met exactly once, in boxes of any size, down to a single cell. Insert and
/// move cost O(1).
template <class Point = CellPoint>
class CellGrid {
 public:
  /// For about `particles` points and queries of about `reach`.
  CellGrid(const PeriodicBox<2>& box, double reach, std::size_t particles) : box_(box) {
    const auto most = static_cast<std::int64_t>(std::ceil(std::sqrt(4.0 * particles))) + 1;
    for (int k = 0; k < 2; ++k) {
      const auto wanted = static_cast<std::int64_t>(box.lengths()[k] / (0.5 * reach));
      count_[k] = std::clamp<std::int64_t>(wanted, 1, most);
      width_[k] = box.lengths()[k] / static_cast<double>(count_[k]);
    }
    first_.assign(static_cast<std::size_t>(count_[0] * count_[1]), none);
    points_.reserve(particles);
  }

  /// Adds point i. Points are numbered 0, 1, 2 …
  void insert(std::size_t i, const Point& point) {
    if (points_.size() <= i) points_.resize(i + 1);
    points_[i] = point;
    enter(static_cast<Index>(i), cell_of(point.position));
  }

  void move(std::size_t i, const Point& point) {
    const std::size_t from = cell_of(points_[i].position), to = cell_of(point.position);
    if (from != to) leave(static_cast<Index>(i), from);
    const Index next = points_[i].next;
    points_[i] = point;
    points_[i].next = next;
    if (from != to) enter(static_cast<Index>(i), to);
  }

  std::size_t size() const { return points_.size(); }
  const Point& operator[](std::size_t i) const { return points_[i]; }

  /// Calls visit(j, shift, separation) for every image r_j + shift ∘ L within `reach` of
  /// `position`, which may lie outside the box; separation = r_j + shift ∘ L − position. A point at
  /// `position` itself is among them. A visit that returns false ends the query; the result tells
  /// whether all were visited.
  template <class Visit>
  bool for_each_near(const Vec2& position, double reach, Visit&& visit) const {
    return for_each_cell(position, reach, [&](std::size_t cell, const Shift<2>& shift) {
      const Vec2 offset = box_.translation(shift) - position;
      for (Index j = first_[cell]; j != none; j = points_[j].next) {
        const Vec2 separation = points_[j].position + offset;
        if (separation.squaredNorm() > reach * reach) continue;
        if (!goes_on(visit, static_cast<std::size_t>(j), shift, separation)) return false;
      }
      return true;
    });
  }

  /// Asks the memory for what a query will read: for the cells, and, when these have had time to come, for
  /// the first point of each.
  void read_ahead_cells(const Vec2& position, double reach) const {
    const Range x = covered(position, reach, 0);
    const Range y = covered(position, reach, 1);
    for (std::int64_t cx = x.low; cx <= x.high; ++cx)
      // Those between are in the same line of memory, or the next.
      for (const std::int64_t cy : {y.low, y.high})
        ask_memory(&first_[inside(cx, 0) * count_[1] + inside(cy, 1)]);
  }
  void read_ahead_points(const Vec2& position, double reach) const {
    for_each_cell(position, reach, [&](std::size_t cell, const Shift<2>&) {
      if (first_[cell] != none) ask_memory(&points_[first_[cell]]);
      return true;
    });
  }

 private:
  using Index = std::uint32_t;
  static constexpr Index none = std::numeric_limits<Index>::max();
  struct Range {
    std::int64_t low, high;
  };

  template <class Visit>
  static bool goes_on(Visit& visit, std::size_t j, const Shift<2>& shift, const Vec2& separation) {
    if constexpr (std::is_same_v<
                      std::invoke_result_t<Visit&, std::size_t, const Shift<2>&, const Vec2&>,
                      bool>) {
      return visit(j, shift, separation);
    } else {
      visit(j, shift, separation);
      return true;
    }
  }

  // visit(cell, shift) for the cells within reach, until one returns false.
  template <class Visit>
  bool for_each_cell(const Vec2& position, double reach, Visit&& visit) const {
    const Range x = covered(position, reach, 0);
    const Range y = covered(position, reach, 1);
    for (std::int64_t cx = x.low; cx <= x.high; ++cx) {
      const std::int32_t boxes_x = boxes_off(cx, 0);
      const std::int64_t column = (cx - boxes_x * count_[0]) * count_[1];
      for (std::int64_t cy = y.low; cy <= y.high; ++cy) {
        const Shift<2> shift(boxes_x, boxes_off(cy, 1));
        const std::int64_t cell = column + cy - shift.y() * count_[1];
        if (!visit(static_cast<std::size_t>(cell), shift)) return false;
      }
    }
    return true;
  }

  // How many boxes a cell lies beyond the first.
  std::int32_t boxes_off(std::int64_t cell, int k) const {
    std::int32_t boxes = 0;
    for (; cell < 0; cell += count_[k]) --boxes;
    for (; cell >= count_[k]; cell -= count_[k]) ++boxes;
    return boxes;
  }

  std::int64_t inside(std::int64_t cell, int k) const {
    return cell - boxes_off(cell, k) * count_[k];
  }

  // Cells that [position − reach, position + reach] covers, with room for rounding at the edges.
  Range covered(const Vec2& position, double reach, int k) const {
    const double centre = position[k] + 0.5 * box_.lengths()[k];
    const double half = reach + 1e-12 * (reach + box_.lengths()[k]);
    return {static_cast<std::int64_t>(std::floor((centre - half) / width_[k])),
            static_cast<std::int64_t>(std::floor((centre + half) / width_[k]))};
  }

  std::size_t cell_of(const Vec2& position) const {
    std::int64_t at[2];
    for (int k = 0; k < 2; ++k)
      at[k] = std::clamp<std::int64_t>(
          static_cast<std::int64_t>((position[k] + 0.5 * box_.lengths()[k]) / width_[k]), 0,
          count_[k] - 1);
    return static_cast<std::size_t>(at[0] * count_[1] + at[1]);
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

  PeriodicBox<2> box_;
  std::int64_t count_[2];
  double width_[2];
  std::vector<Index> first_;  // of every cell, x-major
  std::vector<Point> points_;
};

}  // namespace vitrel
