#pragma once

#include <limits>

/// @file
/// Every tolerance of the program, with its reason and what breaks if it changes.
namespace vitrel::tolerance {

/// The gap at which two bodies are considered to touch. Stored coordinates carry rounding errors of one unit in the
/// last place of the largest coordinate, so a contact is declared a little before the surfaces meet; the exact check of
/// the stored doubles then finds no overlap. If the gap were smaller, rounding could push a pair into an overlap of
/// 1e-16. If it were larger, collisions would come early by gap / approach speed. `extent` is the largest coordinate or
/// length involved (half the box, or the bodies themselves).
inline constexpr double contact_gap(double extent) {
  return 32 * std::numeric_limits<double>::epsilon() * extent;
}

/// In a file of two-dimensional particles with a third coordinate, their heights differ by no more than this, in box
/// lengths: the heights may be rounded to single precision.
inline constexpr double flat = 1e-6;

/// The relative accuracy to which a given packing fraction is met.
inline constexpr double given_fraction = 1e-12;

/// The largest deviations from 1 of the norm of a unit quaternion that is read. Within the first, it counts as one
/// stored in single precision and is normalised. Within the second, it is used as it is, so that the program reads back
/// unchanged what it wrote.
inline constexpr double norm_in_single_precision = 1e-6, norm_in_double_precision = 1e-14;

/// No configuration has a higher packing fraction, not even one of soft particles in contact: a file with a higher one
/// is damaged.
inline constexpr double densest = 2;

/// The limit of positions and semi-axes in box lengths. Shifts then stay below 2¹¹, so that shift ∘ L is exact in 64
/// bits, 53 of which belong to L. With a larger limit, the exact check would no longer be exact.
inline constexpr double max_box_lengths = 300;

}  // namespace vitrel::tolerance
