#pragma once

#include <optional>
#include <utility>

#include "core/geometry/ellipse.h"
#include "core/neighbors/cell_grid.h"
#include "core/state/configuration.h"

/// What all Monte Carlo stages ask of a state: are all particles at least a margin apart?
namespace vitrel {

/// The distance that Monte Carlo keeps between surfaces: the contact gap of the box and its longest
/// particle (tolerances.h), so that rounded coordinates never overlap.
double hard_margin(const Configuration2& configuration);

/// Cells filled with the positions of a configuration, which must be wrapped.
CellGrid<> make_cells(const Configuration2& configuration);

/// Whether a particle keeps the margin to its own images, which lie at whole box lengths.
bool clear_of_own_images(const PeriodicBox<2>& box, const Ellipse& shape, const Vec2& axis,
                         double margin);

/// Calls visit(i, j, d) for every pair (i ≤ j, d from i to the image of j) whose circumcircles meet
/// when all are enlarged by `scale`, and perhaps for some more; each pair once, also (i, i,
/// ±shift).
template <class Visit>
void for_each_pair(const Configuration2& configuration, double scale, Visit&& visit) {
  const CellGrid<> cells = make_cells(configuration);
  const double largest = largest_circumradius(configuration);
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const double reach = scale * (configuration.shape[i].circumradius() + largest);
    cells.for_each_near(
        configuration.position[i], reach, [&](std::size_t j, const Shift<2>& shift, const Vec2& d) {
          const bool after_zero = shift.x() > 0 || (shift.x() == 0 && shift.y() > 0);
          if (j > i || (j == i && after_zero)) visit(i, j, d);
        });
  }
}

/// The first pair closer than the margin, if any.
std::optional<std::pair<std::size_t, std::size_t>> find_overlap(
    const Configuration2& configuration);

/// The factor by which the box and all positions may shrink until the first pair touches, looking
/// no further than `lowest` (then `lowest` is returned); 1 or more if a pair touches or overlaps
/// already. From max F = μ² of every pair (perram_wertheim.h): the pair touches at 1/μ.
double shrink_to_contact(const Configuration2& configuration, double lowest);

/// Scales the sides of the box and all positions by these factors; shapes stay.
void scale_box(Configuration2& configuration, const Vec2& factors);
/// The same by one factor for both sides.
void scale_box(Configuration2& configuration, double factor);

/// Scales to this packing fraction exactly (to rounding).
void scale_to_packing_fraction(Configuration2& configuration, double packing_fraction);

}  // namespace vitrel
