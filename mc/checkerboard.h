#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/periodic_box.h"
#include "core/random/stream.h"

namespace vitrel {

/// A checkerboard decomposition: a periodic box divided into cells, and the cells into rectangular coloured domains, so
/// that particles of several domains can be moved in parallel.
///
/// Cells are at least as wide as the reach of the particles, or as the box if that is shorter: everything within reach
/// of a point lies in its cell or in a near one. Along each direction there is one domain, or an even number of them,
/// each at least four cells wide. Two domains of one colour are separated by one of another colour, wider than the
/// reach: their particles do not interact. The cells are fixed; `shift` moves the borders of the domains by whole
/// cells. Since domains are wider than a cell, no border stays fixed.
class Checkerboard {
 public:
  /// For about `particles` particles, which interact at distances up to `reach`.
  Checkerboard(const PeriodicBox<2>& box, double reach, std::size_t particles);

  /// Moves the borders by a random number of cells, uniform and independent.
  void shift(Stream& draw);

  struct Cell {
    int x, y;
  };
  /// The cell of a wrapped position.
  Cell cell_of(const Vec2& position) const {
    return {lines_[0].cell_of(position.x()), lines_[1].cell_of(position.y())};
  }
  std::size_t cells() const { return lines_[0].cells() * lines_[1].cells(); }
  std::size_t index(const Cell& cell) const { return index(cell.x, cell.y); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(x) * lines_[1].cells() + static_cast<std::size_t>(y);
  }

  /// A column or row near another, as a periodic image.
  struct NearLine {
    int cell;
    double translation;
    double begin;  ///< start of this column or row, relative to the start of the other
  };
  /// The columns near a column, and rows near a row, nearest first: each image within reach once.
  std::span<const NearLine> near_columns(int x) const { return lines_[0].near(x); }
  std::span<const NearLine> near_rows(int y) const { return lines_[1].near(y); }
  /// The lower corner of a cell, and the size of cells.
  Vec2 corner(const Cell& cell) const {
    return {lines_[0].begin_of(cell.x), lines_[1].begin_of(cell.y)};
  }
  Vec2 cell_size() const { return {lines_[0].width(), lines_[1].width()}; }

  std::size_t domains() const { return lines_[0].domains() * lines_[1].domains(); }
  std::size_t domain_of(const Cell& cell) const {
    return lines_[0].domain_of(cell.x) * lines_[1].domains() + lines_[1].domain_of(cell.y);
  }
  /// Domains of one colour; 1, 2 or 4 colours.
  std::span<const std::vector<std::size_t>> colours() const { return colours_; }

  /// Calls visit(cell index) for the cells of a domain.
  template <class Visit>
  void for_each_cell(std::size_t domain, Visit&& visit) const {
    const Line &columns = lines_[0], &rows = lines_[1];
    const std::size_t along_x = domain / rows.domains(), along_y = domain % rows.domains();
    for (std::size_t x = columns.begin(along_x); x < columns.begin(along_x + 1); ++x)
      for (std::size_t y = rows.begin(along_y); y < rows.begin(along_y + 1); ++y)
        visit(index(columns.shifted(x), rows.shifted(y)));
  }

 private:
  // Cells and domains along one direction.
  class Line {
   public:
    Line(double length, double reach, std::size_t particles);
    // Sets the cell at which the first domain begins.
    void set_origin(std::size_t first);

    std::size_t cells() const { return domain_of_.size(); }
    int cell_of(double x) const {
      const int cell = static_cast<int>((x + half_) * cells_per_length_);
      return cell < last_ ? cell : last_;  // rounding at the border of the box
    }
    std::span<const NearLine> near(int cell) const {
      return {near_.data() + static_cast<std::size_t>(cell) * images_, images_};
    }
    double width() const { return 1 / cells_per_length_; }
    double begin_of(int cell) const { return cell / cells_per_length_ - half_; }
    std::size_t domains() const { return domains_; }
    std::size_t domain_of(int cell) const { return domain_of_[static_cast<std::size_t>(cell)]; }
    // The first cell of a domain, counted from the origin; and the cell with such a number.
    std::size_t begin(std::size_t domain) const { return domain * cells() / domains_; }
    int shifted(std::size_t cell) const { return static_cast<int>((origin_ + cell) % cells()); }

   private:
    double half_, cells_per_length_;
    int last_;
    std::size_t images_, domains_, origin_;
    std::vector<NearLine> near_;
    std::vector<std::size_t> domain_of_;
  };

  std::array<Line, 2> lines_;
  std::vector<std::vector<std::size_t>> colours_;
};

}  // namespace vitrel
