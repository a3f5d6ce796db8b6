#pragma once

#include "core/neighbors/cell_grid.h"
#include "core/state/configuration.h"

/// @file
/// The pairs of particles of a configuration that are close to each other.
namespace vitrel {

/// Returns cells filled with the positions of a configuration, which must be wrapped.
template <int Dim>
CellGrid<Dim> make_cells(const Configuration<Dim>& configuration);

/// Calls visit(i, j, d) for every pair (i ≤ j, d from i to the image of j) whose circumcircles (circumspheres) overlap
/// when all are scaled by `scale`, and possibly for some others. Each pair is visited once, including (i, i, ±shift).
template <int Dim, class Visit>
void for_each_pair(const Configuration<Dim>& configuration, double scale, Visit&& visit) {
  const CellGrid<Dim> cells = make_cells(configuration);
  const double largest = largest_circumradius(configuration);
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const double reach = scale * (configuration.shape[i].circumradius() + largest);
    cells.for_each_near(configuration.position[i], reach,
                        [&](std::size_t j, const Shift<Dim>& shift, const Vec<Dim>& d) {
                          if (j > i || (j == i && is_positive_shift(shift))) visit(i, j, d);
                        });
  }
}

}  // namespace vitrel
