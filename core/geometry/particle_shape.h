#pragma once

#include <optional>
#include <type_traits>

#include "core/geometry/ellipse.h"
#include "core/geometry/ellipsoid.h"

/// @file
/// What states, files, Monte Carlo, dynamics, analysis and pages know of the shape of a particle: the concept Body
/// (body.h), and
///
///     half_lengths()             half the sides of the smallest box along its own axes that contains it
///     size()                     the length that its species call its size
///     natural_mass()             that at the density of a round particle of radius 1 and mass 1
///     is_round(), rotations()    whether turns are visible; how many of them smooth collisions change
///     symmetry_axis()            in space: about which turns are not visible, or no_axis
///     inertia_per_mass()         about the own axes
///     fits_into(other)           whether it lies within another of the same centre and orientation
///     scaled(shape, factor)      the same shape of another size
namespace vitrel {

/// The shape of any particle of a configuration.
template <int Dim>
using ParticleShape = std::conditional_t<Dim == 2, Ellipse, Ellipsoid>;

/// The shape with these half lengths along its own axes, if there is one: they are finite and above 0, in the plane the
/// longer first.
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
/// What `shape_of` asks of half lengths, as messages say it.
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
