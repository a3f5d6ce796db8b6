#pragma once

#include <optional>
#include <utility>

#include "core/neighbors/cell_grid.h"
#include "core/state/configuration.h"

/// What all Monte Carlo stages ask of a state: are all particles at least a margin apart?
namespace vitrel {

/// The distance that Monte Carlo keeps between surfaces: the contact gap of the box and its longest
/// particle (tolerances.h), so that rounded coordinates never overlap.
double hard_margin(const Configuration2& configuration);

/// Cells filled with the positions of a configuration, which must be wrapped.
CellGrid make_cells(const Configuration2& configuration);

/// Calls visit(j, shift, d) for every image that can lie closer than `gap` to particle i at
/// `position` by its circumcircle; not for the particle itself, but for its own images.
template <class Visit>
void for_each_candidate(const Configuration2& configuration, const CellGrid& cells, std::size_t i,
                        const Vec2& position, double largest_circumradius, double gap,
                        Visit&& visit) {
  const double reach = configuration.shape[i].circumradius() + largest_circumradius + gap;
  cells.for_each_near(position, reach, [&](std::size_t j, const Shift<2>& shift, const Vec2& d) {
    if (j == i && shift.isZero()) return;
    visit(j, shift, d);
  });
}

/// The first pair closer than the margin, if any.
std::optional<std::pair<std::size_t, std::size_t>> find_overlap(
    const Configuration2& configuration);

/// The factor by which the box and all positions may shrink until the first pair touches, looking
/// no further than `lowest` (then `lowest` is returned); 1 or more if a pair touches or overlaps
/// already. From max F = μ² of every pair (perram_wertheim.h): the pair touches at 1/μ.
double shrink_to_contact(const Configuration2& configuration, double lowest);

/// Scales the box and all positions by a factor; shapes stay.
void scale_box(Configuration2& configuration, double factor);

/// Scales to this packing fraction exactly (to rounding).
void scale_to_packing_fraction(Configuration2& configuration, double packing_fraction);

}  // namespace vitrel
