#pragma once

#include <optional>
#include <type_traits>

#include "core/geometry/ellipse.h"
#include "core/geometry/ellipsoid.h"

/// @file
/// The interface of the shape of a particle that states, files, Monte Carlo, dynamics, analysis and pages use. It
/// consists of the concept Body (body.h) and
///
///     half_lengths()             half the sides of the smallest box along the particle's own axes that contains it
///     size()                     the length that its species calls its size
///     natural_mass()             its mass at the density of a round particle of radius 1 and mass 1
///     is_round()                 whether all rotations leave it unchanged
///     rotations()                how many rotational degrees of freedom smooth collisions change
///     symmetry_axis()            in three dimensions: the axis about which it is symmetric, or no_axis
///     inertia_per_mass()         its moments of inertia about its own axes, divided by the mass
///     fits_into(other)           whether it lies within another shape of the same centre and orientation
///     scaled(shape, factor)      the shape with all lengths multiplied by the factor
namespace vitrel {

/// The shape of any particle of a configuration.
template <int Dim>
using ParticleShape = std::conditional_t<Dim == 2, Ellipse, Ellipsoid>;

/// Returns the shape with these half lengths along its own axes, if there is one: they must be finite and positive, and
/// in the plane the longer must come first.
template <int Dim>
std::optional<ParticleShape<Dim>> shape_of(const Vec<Dim>& half_lengths) {
  if (!(half_lengths.allFinite() && half_lengths.minCoeff() > 0)) return std::nullopt;
  if constexpr (Dim == 2) {
    if (half_lengths[0] < half_lengths[1]) return std::nullopt;
    return Ellipse{half_lengths[0], half_lengths[1]};
  } else {
    return Ellipsoid{half_lengths};
  }
}
/// The condition of `shape_of` on half lengths, in the words of messages.
template <int Dim>
constexpr const char* half_lengths_rule() {
  return Dim == 2 ? "a ≥ b > 0" : "three semi-axes above 0";
}

/// The disk or sphere of this radius.
template <int Dim>
ParticleShape<Dim> round_shape(double radius) {
  if constexpr (Dim == 2)
    return {radius, radius};
  else
    return {Vec3::Constant(radius)};
}

}  // namespace vitrel
