#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// Colours of particles; the report page uses the same ones (workflow/report/page/common.js and solids.js).
namespace vitrel {

/// Red, green and blue in sRGB.
using Colour = std::array<std::uint8_t, 3>;

/// Viridis for x from 0 to 1. Values outside are clamped, and NaN has the colour of 0.
Colour sequential_colour(double x);
/// The colour of an axis in the plane. It runs once around the circle of colours in half a turn of the axis.
Colour orientation_colour(double angle);
/// The colour of an axis w of norm 1 in space. It mixes the colours of x, y and z with the shares w_k².
Colour orientation_colour(const Vec3& axis);
Colour species_colour(std::int32_t species);

/// The names of the colourings and what they show:
///
///     orientation     of the major axis, in space of figure_axis; round particles are grey
///     species         the number of the species
///     psi6            |ψ₆| of the particle (analysis/structure/order.h) from 0 to 1, in the plane only
///     displacement    from the first frame; the scale ends at the displacement that 2 % of the particles
///                     exceed in the last frame
///     size            √(ab), in space ∛(abc), from the smallest to the largest particle
const std::vector<std::string>& colourings();
/// "orientation", or "species" if all particles are round.
template <int Dim>
std::string default_colouring(const Configuration<Dim>& configuration);

/// The range of numbers that sequential_colour covers from one end to the other.
struct ColourScale {
  double low = 0, high = 1;
};

/// The scale from the smallest to the largest value.
ColourScale range_of(const std::vector<double>& values);

/// The colours of all particles. `scale` is set by psi6 and size, and other colourings leave it as it is. Throws
/// UserError if there is no such colouring, or if it needs the other dimension or several frames.
template <int Dim>
std::vector<Colour> particle_colours(const Configuration<Dim>& configuration,
                                     const std::string& colouring,
                                     std::optional<ColourScale>& scale);

std::vector<Colour> sequential_colours(const std::vector<double>& values, const ColourScale& scale);

/// The scale from 0 to the displacement that 2 % of these exceed, or to 1 if that is 0.
ColourScale displacement_scale(std::vector<double> displacements);

}  // namespace vitrel
