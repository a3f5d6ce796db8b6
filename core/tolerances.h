#pragma once

#include <limits>

/// @file
/// Every tolerance of the program: its reason, and what breaks if it changes.
namespace vitrel::tolerance {

/// The gap at which two bodies are said to touch. Stored coordinates carry rounding errors of one unit
/// in the last place of the largest coordinate, so a contact is declared a little before the surfaces
/// meet: then the exact check of the stored doubles finds no overlap. Smaller: rounding may push a pair
/// into an overlap of 1e-16. Larger: collisions come early by gap / approach speed.
/// `extent` is the largest coordinate or length involved (half the box, or the bodies themselves).
inline constexpr double contact_gap(double extent) {
  return 32 * std::numeric_limits<double>::epsilon() * extent;
}

/// Heights of the particles of a plane differ by no more than this, in box lengths: rounding to single precision.
inline constexpr double flat = 1e-6;

/// Packing fractions and species fractions given by a user are met to this relative accuracy.
inline constexpr double given_fraction = 1e-12;

/// How far the norm of a unit quaternion may be from 1: one stored in single precision, which is normalised, and one that
/// is used as it is, so that what the program wrote it reads back unchanged.
inline constexpr double norm_in_single_precision = 1e-6, norm_in_double_precision = 1e-14;

/// A packing fraction that no configuration has, not even of soft particles in contact. A file with a higher one is damaged.
inline constexpr double densest = 2;

/// Limit of positions and semi-axes in box lengths. Shifts then stay below 2¹¹, so that shift ∘ L
/// is exact in 64 bits, 53 of which belong to L. Larger: the exact check would no longer be exact.
inline constexpr double max_box_lengths = 300;

}  // namespace vitrel::tolerance
