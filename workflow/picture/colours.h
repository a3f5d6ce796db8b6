#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// Colours of particles: those of the report page (workflow/report/page/common.js and solids.js).
namespace vitrel {

/// Red, green and blue in sRGB.
using Colour = std::array<std::uint8_t, 3>;

/// Viridis, for x from 0 to 1; beyond, its ends, and for NaN the first.
Colour sequential_colour(double x);
/// The colour of an axis in the plane goes once around the circle of colours in half a turn.
Colour orientation_colour(double angle);
/// The colour of an axis w in space, of norm 1, mixes those of x, y and z with the shares w_k².
Colour orientation_colour(const Vec3& axis);
Colour species_colour(std::int32_t species);

/// What colours mean:
///
///     orientation     of the major axis, in space of figure_axis; round particles are grey
///     species         the number of the species
///     psi6            |ψ₆| of the particle (analysis/structure/order.h) from 0 to 1; in the plane
///     displacement    from the first frame, up to the one that 2 % of the particles exceed in the last
///     size            √(ab), in space ∛(abc), from the smallest to the largest particle
const std::vector<std::string>& colourings();
/// orientation, or species if all particles are round.
template <int Dim>
std::string default_colouring(const Configuration<Dim>& configuration);

/// Numbers from `low` to `high`, where sequential_colour is at its ends.
struct ColourScale {
  double low = 0, high = 1;
};

/// From the smallest to the largest value.
ColourScale range_of(const std::vector<double>& values);

/// The colours of all particles. `scale` becomes that of psi6 and size, and is left alone by others. UserError if there
/// is no such colouring, or if it needs the other dimension or several frames.
template <int Dim>
std::vector<Colour> particle_colours(const Configuration<Dim>& configuration,
                                     const std::string& colouring,
                                     std::optional<ColourScale>& scale);

std::vector<Colour> sequential_colours(const std::vector<double>& values, const ColourScale& scale);

/// From 0 to the displacement that 2 % of these exceed, or to 1 if that is 0.
ColourScale displacement_scale(std::vector<double> displacements);

}  // namespace vitrel
