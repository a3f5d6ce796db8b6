#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/contact/simd.h"
#include "core/geometry/periodic_box.h"
#include "core/random/stream.h"

namespace vitrel {

/// A checkerboard decomposition in two or three dimensions: a periodic box is divided into cells, and the cells into
/// rectangular coloured domains, so that particles of several domains can be moved in parallel.
///
/// Cells are at least as wide as the reach of the particles, or as the box if that is shorter: everything within reach
/// of a point lies in its cell or in a near one. Along each direction there is one domain, or an even number of them,
/// each at least four cells wide. Between two domains of one colour lies a domain of another colour that is wider than
/// the reach, so their particles do not interact. The cells are fixed; `shift` moves the borders of the domains by
/// whole cells. Since domains are wider than a cell, no border stays fixed.
template <int Dim>
class Checkerboard {
 public:
  /// Divides the box for about `particles` particles, which interact at distances up to `reach`.
  Checkerboard(const PeriodicBox<Dim>& box, double reach, std::size_t particles);

  /// Moves the borders along each direction by a random number of cells, uniform and independent.
  void shift(Stream& draw);

  /// The column, row and layer of a cell.
  using Cell = std::array<int, Dim>;
  /// Returns the cell of a wrapped position.
  Cell cell_of(const Vec<Dim>& position) const {
    Cell cell;
    for (int k = 0; k < Dim; ++k) cell[k] = lines_[k].cell_of(position[k]);
    return cell;
  }
  std::size_t cells() const {
    return product([](const Line& line) { return line.cells(); });
  }
  std::size_t index(const Cell& cell) const {
    std::size_t index = 0;
    for (int k = 0; k < Dim; ++k)
      index = index * lines_[k].cells() + static_cast<std::size_t>(cell[k]);
    return index;
  }

  /// A column, row or layer near another one, as a periodic image.
  struct NearLine {
    int cell;
    double translation;
    double begin;  ///< start, relative to the start of the other one
  };
  /// Returns the columns (rows, layers) near that of a cell, nearest first; each image within reach occurs once.
  std::span<const NearLine> near(const Cell& cell, int direction) const {
    return lines_[direction].near(cell[direction]);
  }
  /// A translation by whole boxes. It is no Vec, since vectors that are written by component and read as a whole stall
  /// the processor.
  using Translation = std::array<double, Dim>;
  /// Calls visit(index of a cell, translation) for the cells near `cell`, nearest first, until a call returns false.
  /// Returns whether all were visited.
  template <class Visit>
  VITREL_INLINE bool for_each_near(const Cell& cell, Visit&& visit) const {
    return walk<0>(cell, 0, {}, visit);
  }
  /// `corner` returns the lower corner of a cell, and `cell_size` the size of all cells.
  Vec<Dim> corner(const Cell& cell) const {
    Vec<Dim> corner;
    for (int k = 0; k < Dim; ++k) corner[k] = lines_[k].begin_of(cell[k]);
    return corner;
  }
  Vec<Dim> cell_size() const {
    Vec<Dim> size;
    for (int k = 0; k < Dim; ++k) size[k] = lines_[k].width();
    return size;
  }

  std::size_t domains() const {
    return product([](const Line& line) { return line.domains(); });
  }
  std::size_t domain_of(const Cell& cell) const {
    std::size_t domain = 0;
    for (int k = 0; k < Dim; ++k)
      domain = domain * lines_[k].domains() + lines_[k].domain_of(cell[k]);
    return domain;
  }
  /// Returns the domains of each colour; there are 1, 2, 4 or 8 colours.
  std::span<const std::vector<std::size_t>> colours() const { return colours_; }

  /// Calls visit(cell index) for the cells of a domain.
  template <class Visit>
  void for_each_cell(std::size_t domain, Visit&& visit) const {
    std::array<std::size_t, Dim> along;
    for (int k = Dim; k-- > 0; domain /= lines_[k].domains())
      along[k] = domain % lines_[k].domains();
    walk_domain<0>(along, 0, visit);
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
      return cell < last_ ? cell : last_;  // rounding at the border of the box may exceed it
    }
    std::span<const NearLine> near(int cell) const {
      return {near_.data() + static_cast<std::size_t>(cell) * images_, images_};
    }
    double width() const { return 1 / cells_per_length_; }
    double begin_of(int cell) const { return cell / cells_per_length_ - half_; }
    std::size_t domains() const { return domains_; }
    std::size_t domain_of(int cell) const { return domain_of_[static_cast<std::size_t>(cell)]; }
    // `begin` is the first cell of a domain, counted from the origin; `shifted` is the cell with such a number.
    std::size_t begin(std::size_t domain) const { return domain * cells() / domains_; }
    int shifted(std::size_t cell) const { return static_cast<int>((origin_ + cell) % cells()); }

   private:
    double half_, cells_per_length_;
    int last_;
    std::size_t images_, domains_, origin_;
    std::vector<NearLine> near_;
    std::vector<std::size_t> domain_of_;
  };

  template <class Count>
  std::size_t product(const Count& count) const {
    std::size_t all = 1;
    for (const Line& line : lines_) all *= count(line);
    return all;
  }

  // Visits the cells near `cell` along direction k and later ones; `before` and `translation` belong to the directions
  // before k.
  template <int k, class Visit>
  VITREL_INLINE bool walk(const Cell& cell, std::size_t before, Translation translation,
                          Visit& visit) const {
    for (const NearLine& line : lines_[k].near(cell[k])) {
      const std::size_t at = before * lines_[k].cells() + static_cast<std::size_t>(line.cell);
      translation[k] = line.translation;
      if constexpr (k + 1 < Dim) {
        if (!walk<k + 1>(cell, at, translation, visit)) return false;
      } else {
        if (!visit(at, translation)) return false;
      }
    }
    return true;
  }
  template <int k, class Visit>
  void walk_domain(const std::array<std::size_t, Dim>& along, std::size_t before,
                   Visit& visit) const {
    const Line& line = lines_[k];
    for (std::size_t c = line.begin(along[k]); c < line.begin(along[k] + 1); ++c) {
      const std::size_t at = before * line.cells() + static_cast<std::size_t>(line.shifted(c));
      if constexpr (k + 1 < Dim)
        walk_domain<k + 1>(along, at, visit);
      else
        visit(at);
    }
  }

  static std::array<Line, Dim> make_lines(const PeriodicBox<Dim>& box, double reach,
                                          std::size_t particles) {
    return [&]<std::size_t... k>(std::index_sequence<k...>) {
      return std::array<Line, Dim>{Line(box.lengths()[k], reach, particles)...};
    }
    (std::make_index_sequence<Dim>());
  }

  std::array<Line, Dim> lines_;
  std::vector<std::vector<std::size_t>> colours_;
};

}  // namespace vitrel
