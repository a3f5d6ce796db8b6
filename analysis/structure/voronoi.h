#pragma once

#include <cstdint>
#include <vector>

#include "core/neighbors/cell_grid.h"
#include "core/state/configuration.h"

namespace vitrel {

/// One side of a Voronoi cell, with the neighbour beyond it.
struct VoronoiEdge {
  Vec2 to;  ///< from the centre of the cell to that of the neighbour, which may be an own image
  double length;
  std::size_t neighbor;
};

struct VoronoiCell {
  double area;
  std::vector<VoronoiEdge> edges;  ///< in counter-clockwise order
};

/// Voronoi cells of the centres in the periodic box: the cell of a particle is all that lies nearer to its centre than
/// to any other, images included. Cells fill the box, and have six edges on the average.
///
/// A cell begins as the box itself, whose sides are the bisectors to the nearest own images. Every other centre then
/// cuts off what lies beyond its bisector, near ones first, until the next one is more than twice as far as the
/// farthest corner. Where four cells meet in a point (square lattice), rounding may leave edges of about 1e-16 between
/// opposite cells, so neighbours should be weighted by the length of the edge.
///
/// Positions must be wrapped, and no two of them may be equal. The cost is about O(N) for all cells if the density is
/// about even.
class Voronoi {
 public:
  explicit Voronoi(const Configuration2& configuration);
  VoronoiCell cell(std::size_t i) const;
  /// Returns the particles in an order in which neighbours mostly follow each other; cells made in this order are made
  /// fastest.
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  /// Another centre, seen from the centre of a cell.
  struct Point {
    Vec2 at;
    double squared;  ///< squared distance
    std::size_t number;
  };

  std::vector<Point> others_within(double reach, std::size_t place) const;
  std::vector<Point> all_others(std::size_t place) const;

  Vec2 lengths_;
  std::vector<std::uint32_t> order_, place_;  // place of every particle in that order
  double reach_;                              // distance within which the neighbours usually are
  CellGrid<2> centres_;
};

}  // namespace vitrel
