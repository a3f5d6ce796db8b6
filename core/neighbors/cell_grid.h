#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/geometry/periodic_box.h"
#include "core/neighbors/list_pool.h"

namespace vitrel {

/// Points in the cells of a periodic box, to find those near a place.
///
/// A query walks the cells that its reach covers in unwrapped cell coordinates; a cell beyond the
/// box is the image of one inside, and how many boxes lie between is the shift. So every image (j,
/// shift) within reach is met exactly once, in boxes of any size, down to a single cell. Insert,
/// move and remove cost O(1).
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
    const auto cells = static_cast<std::size_t>(count_[0] * count_[1]);
    members_ = ListPool<Index>(cells);
    members_.reserve(std::vector<std::uint32_t>(cells, particles / cells));
    position_.reserve(particles);
    cell_.reserve(particles);
  }

  /// Adds point i at a position wrapped into the box. Points are numbered 0, 1, 2 …
  void insert(std::size_t i, const Vec2& position) {
    if (position_.size() <= i) {
      position_.resize(i + 1);
      cell_.resize(i + 1);
    }
    position_[i] = position;
    enter(static_cast<Index>(i), cell_of(position));
  }

  void remove(std::size_t i) { leave(static_cast<Index>(i)); }

  void move(std::size_t i, const Vec2& position) {
    const Index cell = cell_of(position);
    position_[i] = position;
    if (cell == cell_[i]) return;
    leave(static_cast<Index>(i));
    enter(static_cast<Index>(i), cell);
  }

  const Vec2& position(std::size_t i) const { return position_[i]; }

  /// Calls visit(j, shift, separation) for every image r_j + shift ∘ L within `reach` of
  /// `position`, which may lie outside the box; separation = r_j + shift ∘ L − position. A point at
  /// `position` itself is among them. A visit that returns false ends the query; the result tells
  /// whether all were visited.
  template <class Visit>
  bool for_each_near(const Vec2& position, double reach, Visit&& visit) const {
    const Range x = covered(position, reach, 0);
    const Range y = covered(position, reach, 1);
    for (std::int64_t cx = x.low; cx <= x.high; ++cx) {
      const std::int32_t boxes_x = boxes_off(cx, 0);
      const std::int64_t column = (cx - boxes_x * count_[0]) * count_[1];
      for (std::int64_t cy = y.low; cy <= y.high; ++cy) {
        const Shift<2> shift(boxes_x, boxes_off(cy, 1));
        const std::int64_t cell = column + cy - shift.y() * count_[1];
        const Vec2 offset = box_.translation(shift) - position;
        for (const Index j : members_[static_cast<std::size_t>(cell)]) {
          const Vec2 separation = position_[j] + offset;
          if (separation.squaredNorm() > reach * reach) continue;
          if (!goes_on(visit, static_cast<std::size_t>(j), shift, separation)) return false;
        }
      }
    }
    return true;
  }

 private:
  using Index = std::uint32_t;
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

  // How many boxes a cell lies beyond the first.
  std::int32_t boxes_off(std::int64_t cell, int k) const {
    std::int32_t boxes = 0;
    for (; cell < 0; cell += count_[k]) --boxes;
    for (; cell >= count_[k]; cell -= count_[k]) ++boxes;
    return boxes;
  }

  // Cells that [position − reach, position + reach] covers, with room for rounding at the edges.
  Range covered(const Vec2& position, double reach, int k) const {
    const double centre = position[k] + 0.5 * box_.lengths()[k];
    const double half = reach + 1e-12 * (reach + box_.lengths()[k]);
    return {static_cast<std::int64_t>(std::floor((centre - half) / width_[k])),
            static_cast<std::int64_t>(std::floor((centre + half) / width_[k]))};
  }

  Index cell_of(const Vec2& position) const {
    std::int64_t at[2];
    for (int k = 0; k < 2; ++k)
      at[k] = std::clamp<std::int64_t>(
          static_cast<std::int64_t>((position[k] + 0.5 * box_.lengths()[k]) / width_[k]), 0,
          count_[k] - 1);
    return static_cast<Index>(at[0] * count_[1] + at[1]);
  }

  void enter(Index i, Index cell) {
    cell_[i] = cell;
    members_.add(cell, i);
  }

  void leave(Index i) {
    members_.remove_if(cell_[i], [i](Index member) { return member == i; });
  }

  PeriodicBox<2> box_;
  std::int64_t count_[2];
  double width_[2];
  ListPool<Index> members_;  // of every cell, x-major
  std::vector<Vec2> position_;
  std::vector<Index> cell_;
};

}  // namespace vitrel
