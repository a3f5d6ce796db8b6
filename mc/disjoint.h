#pragma once

#include <optional>
#include <utility>

#include "core/geometry/ellipse.h"
#include "core/state/configuration.h"

/// What all Monte Carlo stages ask of a state: are all particles at least a margin apart?
namespace vitrel {

/// The distance that Monte Carlo keeps between surfaces: the contact gap of the box and its longest
/// particle (tolerances.h), so that rounded coordinates never overlap.
double hard_margin(const Configuration2& configuration);

/// Whether a particle keeps the margin to its own images, which lie at whole box lengths.
bool clear_of_own_images(const PeriodicBox<2>& box, const Ellipse& shape, const Vec2& axis,
                         double margin);

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
