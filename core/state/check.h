#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// The exact check of a whole state: which hard particles overlap, judged from the stored doubles
/// in extended arithmetic, over all images, with tolerance zero and without any code of the engine.
///
/// Positions, orientations, semi-axes and box lengths are taken into `Extended` unchanged (core/extended.h: long double,
/// or the sum of two doubles where that is short); a pair is (i, j, shift), with i = j for a particle and its own image.
/// Round particles are compared by the distance of their centres. Other pairs whose circumcircles (spheres) meet are
/// judged by the complete Vieillard-Baron criterion (core/contact/ellipse_vieillard_baron.h), in three dimensions by the
/// completed criterion of the characteristic polynomial (core/contact/ellipsoid_eta.h). Crossed and contained overlaps
/// are found like any other.
///
/// Most pairs never get there: double precision proves them to be apart, by their circumcircles or by a
/// separating axis, with a margin of more than a hundred times its rounding errors. What it cannot prove,
/// extended arithmetic decides, so no result depends on it.
///
/// Tolerance zero: an overlap by any amount is one, a touch is none. The evaluation
/// itself is blurred by a few hundred units of rounding, at most 2⁻⁶⁴ of the coordinates each: a
/// pair that touches exactly, or misses touching by less than about 1e-17 of the largest length
/// involved, may be judged either way. That is far below the spacing of the stored doubles, so
/// whatever doubles can express about two particles is judged right, except that a state meant to
/// touch exactly usually cannot be stored. So both arithmetics find the same overlaps (scripts/validate extended:
/// on 2 · 10⁷ pairs no verdict differs), and their smallest gaps agree in all but the last digits.
///
/// The close pairs that the configuration names, soft particles just after a damped collision, may overlap: as
/// long as their centres are no closer than stated there. They do not count for the smallest gap.
///
/// Cost: proportional to N by cells as wide as three of the longest semi-axes. Up to `brute_force_limit`
/// particles there is a single cell, which means all pairs. With the sum of two doubles a dense state takes 1.4 to 2.1
/// times as long as with the long double of x86 (4000 ellipses of aspect ratio 2 and 6, 2000 ellipsoids).
namespace vitrel {

template <int Dim>
struct ExactCheck {
  /// All overlapping pairs in ascending order of (i, j, shift).
  std::vector<PairImage<Dim>> overlaps;
  /// The smallest distance of two surfaces, good to rounding of the coordinates; negative if there
  /// are overlaps: the depth of the deepest, that is, the shortest translation that would undo it
  /// (of a crossed pair, a close upper bound of that). Infinity if no two surfaces are closer than
  /// the longest semi-axis in the state.
  double smallest_gap;
  /// Number of pairs (i, j, shift) whose circumcircles (spheres) meet.
  std::uint64_t pairs_examined;

  bool clean() const { return overlaps.empty(); }
};

/// Throws InvariantError if a number is not finite, if a semi-axis is not positive (in two dimensions if
/// not 0 < b ≤ a), if the norm of a quaternion is not 1, or if a position or semi-axis exceeds 300 box
/// lengths (positions are stored wrapped). Quaternions are normalised in extended arithmetic. Box lengths
/// are from 1e-70 to 1e70, so that no product leaves the range of doubles.
template <int Dim>
ExactCheck<Dim> exact_check(const Configuration<Dim>& configuration,
                            std::size_t brute_force_limit = 100);

}  // namespace vitrel
