#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/contact/simd.h"
#include "core/elementary.h"
#include "core/geometry/periodic_box.h"
#include "core/large_vector.h"
#include "core/neighbors/prefetch.h"

namespace vitrel {

/// A cell list that holds the positions of its points inside the cells, so that a query reads one cache line per cell
/// and tests four points at once.
///
/// Positions are stored in single precision, relative to the corner of their cell. A query is therefore conservative:
/// it finds all points of a region, and possibly others within 10⁻⁶ (reach + cell width) of it. A cell outside the box
/// is the image of one inside, so each image is found exactly once, in boxes of any size.
template <int Dim>
class InlineCellList {
 public:
  using Index = std::uint32_t;

  /// Makes cells for about `points` points; they are at least `min_width` wide, or as wide as the box.
  InlineCellList(const PeriodicBox<Dim>& box, double min_width, std::size_t points) : box_(box) {
    constexpr double cells_per_point = 4;
    const double max_count =
        std::ceil(root(cells_per_point * static_cast<double>(points), Dim)) + 1;
    std::int64_t cells = 1;
    for (int k = Dim - 1; k >= 0; --k) {
      count_[k] =
          static_cast<std::int32_t>(std::clamp(box.lengths()[k] / min_width, 1.0, max_count));
      width_[k] = box.lengths()[k] / count_[k];
      per_width_[k] = 1 / width_[k];
      stride_[k] = cells;
      cells *= count_[k];
    }
    cells_.resize(static_cast<std::size_t>(cells));
  }

  /// Positions must be wrapped into the box.
  void insert(std::size_t i, const Vec<Dim>& position) {
    const Place place = place_of(position);
    insert(cells_[place.cell], static_cast<Index>(i), place.relative);
  }
  void move(std::size_t i, const Vec<Dim>& from, const Vec<Dim>& to) {
    remove(cells_[place_of(from).cell], static_cast<Index>(i));
    insert(i, to);
  }

  /// Calls visit(j, shift) for every image r_j + shift ∘ L within `outer` of `centre`, except those certainly within
  /// `inner` of centre + offset.
  template <class Visit>
  void for_each_in_shell(const Vec<Dim>& centre, double outer, const Vec<Dim>& offset, double inner,
                         Visit&& visit) {
    const Shell shell = conservative(outer, offset, inner);
    for_each_cell(centre, outer, [&](std::size_t at, const Corner& corner, const auto& shift_of) {
      const Cell* cell = &cells_[at];
      while (true) {
        for (unsigned hits = cell->inside(shell, corner); hits != 0; hits &= hits - 1)
          visit(static_cast<std::size_t>(cell->index[std::countr_zero(hits)]), shift_of());
        if (!cell->is_continued()) return;
        cell = &overflow_[cell->continuation()];
      }
    });
  }

  /// Prefetches the cells that a query reads.
  void prefetch(const Vec<Dim>& centre, double outer) {
    for_each_cell(centre, outer,
                  [&](std::size_t at, const Corner&, const auto&) { prefetch_line(&cells_[at]); });
  }

 private:
  static constexpr int lanes = 4;
  static constexpr float nowhere = 1e18f;
  static constexpr Index none = 0x7fffffff, link = 0x80000000;
  using Floats = detail::FloatRegister;
  using Corner = std::array<float, Dim>;  // corner relative to the centre of a query

  struct Shell {
    float outer_square, inner_square;
    std::array<float, Dim> offset;
  };

  /// A cell holds up to four points in any lanes; if there are more, the last lane refers to another cell.
  struct alignas(64) Cell {
    Floats coordinate[Dim];
    std::array<Index, lanes> index;

    Cell() {
      for (int k = 0; k < lanes; ++k) clear(k);
    }
    void set(int lane, Index i, const Corner& relative) {
      for (int k = 0; k < Dim; ++k) coordinate[k][lane] = relative[k];
      index[lane] = i;
    }
    void clear(int lane) {
      for (int k = 0; k < Dim; ++k) coordinate[k][lane] = nowhere;
      index[lane] = none;
    }
    bool is_continued() const { return (index[lanes - 1] & link) != 0; }
    Index continuation() const { return index[lanes - 1] & ~link; }
    /// Returns the lane of a point, or −1.
    int lane_of(Index i) const {
      const auto* const found = std::ranges::find(index, i);
      return found == index.end() ? -1 : static_cast<int>(found - index.begin());
    }
    /// Returns the lanes with points inside the shell.
    unsigned inside(const Shell& shell, const Corner& corner) const {
      Floats square{}, inner_square{};
      for (int k = 0; k < Dim; ++k) {
        const Floats d = coordinate[k] + corner[k], from_offset = d - shell.offset[k];
        square += d * d;
        inner_square += from_offset * from_offset;
      }
      return detail::bits((square <= shell.outer_square) & (inner_square >= shell.inner_square));
    }
  };
  struct Place {
    std::size_t cell;
    Corner relative;
  };
  /// One layer of cells of a query, in one direction.
  struct Layer {
    std::int64_t cell;   // contribution to the cell number
    std::int32_t shift;  // boxes beyond the first
    float corner, min_square;
  };

  Shell conservative(double outer, const Vec<Dim>& offset, double inner) const {
    const double rounding = rounding_of(outer);
    Shell shell;
    shell.outer_square = static_cast<float>((outer + rounding) * (outer + rounding));
    shell.inner_square =
        inner > rounding ? static_cast<float>((inner - rounding) * (inner - rounding)) : 0;
    for (int k = 0; k < Dim; ++k) shell.offset[k] = static_cast<float>(offset[k]);
    return shell;
  }
  double rounding_of(double reach) const {
    return 1e-6 * (reach + *std::max_element(width_, width_ + Dim));
  }

  Place place_of(const Vec<Dim>& position) const {
    Place place;
    std::int64_t cell = 0;
    for (int k = 0; k < Dim; ++k) {
      const double x = position[k] + 0.5 * box_.lengths()[k];
      const auto at = std::clamp(static_cast<std::int32_t>(x * per_width_[k]), 0, count_[k] - 1);
      place.relative[k] = static_cast<float>(x - at * width_[k]);
      cell += at * stride_[k];
    }
    place.cell = static_cast<std::size_t>(cell);
    return place;
  }

  void insert(Cell& first, Index i, const Corner& relative) {
    Cell* cell = &first;
    while (true) {
      const int lane = cell->lane_of(none);
      if (lane >= 0) return cell->set(lane, i, relative);
      if (!cell->is_continued()) break;
      cell = &overflow_[cell->continuation()];
    }
    extend(*cell, i, relative);
  }

  // Moves the last point of a full cell and the new one into a further cell.
  void extend(Cell& cell, Index i, const Corner& relative) {
    constexpr int last = lanes - 1;
    Cell further;
    Corner moved;
    for (int k = 0; k < Dim; ++k) moved[k] = cell.coordinate[k][last];
    further.set(0, cell.index[last], moved);
    further.set(1, i, relative);
    cell.clear(last);
    cell.index[last] = link | static_cast<Index>(overflow_.size());
    overflow_.push_back(further);  // done last, since `cell` may be in the same array
  }

  void remove(Cell& first, Index i) {
    Cell* cell = &first;
    int lane = cell->lane_of(i);
    while (lane < 0) {
      cell = &overflow_[cell->continuation()];
      lane = cell->lane_of(i);
    }
    cell->clear(lane);
  }

  // Calls visit(cell, corner, shift_of) for the cells that come within reach of `centre`.
  template <class Visit>
  void for_each_cell(const Vec<Dim>& centre, double reach, Visit&& visit) {
    const double limit = reach + rounding_of(reach);
    const auto max_square = static_cast<float>(limit * limit * (1 + 1e-6));
    for (int k = 0; k < Dim; ++k) find_layers(centre, limit, k);
    Corner corner;
    for (const Layer& x : layers_[0]) {
      corner[0] = x.corner;
      for (const Layer& y : layers_[1]) {
        const float square = x.min_square + y.min_square;
        if (square > max_square) continue;
        corner[1] = y.corner;
        if constexpr (Dim == 2) {
          visit(static_cast<std::size_t>(x.cell + y.cell), std::as_const(corner),
                [&] { return Shift<2>(x.shift, y.shift); });
        } else {
          for (const Layer& z : layers_[2]) {
            if (square + z.min_square > max_square) continue;
            corner[2] = z.corner;
            visit(static_cast<std::size_t>(x.cell + y.cell + z.cell), std::as_const(corner),
                  [&] { return Shift<3>(x.shift, y.shift, z.shift); });
          }
        }
      }
    }
  }

  void find_layers(const Vec<Dim>& centre, double reach, int k) {
    const double x = centre[k] + 0.5 * box_.lengths()[k];
    const auto low = static_cast<std::int32_t>(std::floor((x - reach) * per_width_[k]));
    const auto high = static_cast<std::int32_t>(std::floor((x + reach) * per_width_[k]));
    std::int32_t shift = 0, wrapped = low;
    for (; wrapped < 0; wrapped += count_[k]) --shift;
    for (; wrapped >= count_[k]; wrapped -= count_[k]) ++shift;
    layers_[k].resize(static_cast<std::size_t>(high - low) + 1);
    const auto width = static_cast<float>(width_[k]);
    auto c = static_cast<double>(low);
    for (Layer& layer : layers_[k]) {
      const auto corner = static_cast<float>(c * width_[k] - x);
      const float apart = std::max(std::max(corner, -corner - width), 0.f);
      layer = {wrapped * stride_[k], shift, corner, apart * apart};
      c += 1;
      if (++wrapped == count_[k]) wrapped = 0, ++shift;
    }
  }

  PeriodicBox<Dim> box_;
  std::int32_t count_[Dim];   // number of cells
  std::int64_t stride_[Dim];  // step of the cell number
  double width_[Dim], per_width_[Dim];
  LargeVector<Cell> cells_, overflow_;
  std::vector<Layer> layers_[Dim];  // layers of the current query
};

}  // namespace vitrel
