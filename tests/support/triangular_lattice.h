#pragma once

#include <cmath>

#include "core/state/configuration.h"

namespace vitrel {

/// Disks of radius 1 at the points of a triangular lattice, row by row, an even number of rows.
/// Everything is stretched along x, so that disks become ellipses. No point is on an edge of the
/// box.
inline Configuration2 triangular_lattice(int columns, int rows, double spacing,
                                         double stretch = 1) {
  const Vec2 cell = spacing * Vec2(stretch, std::sqrt(0.75));
  Configuration2 c;
  c.box = PeriodicBox<2>(cell.cwiseProduct(Vec2(columns, rows)));
  c.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  c.shape.assign(c.size(), Ellipse{stretch, 1});
  for (int row = 0, i = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column, ++i) {
      const Vec2 place(column + 0.5 * (row % 2) + 0.1, row + 0.2);
      c.position[i] = cell.cwiseProduct(place) - 0.5 * c.box.lengths();
      c.box.wrap(c.position[i], c.image[i]);
    }
  return c;
}

}  // namespace vitrel
