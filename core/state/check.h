#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// The exact check of a whole state finds the hard particles that overlap. It evaluates the stored doubles in extended
/// arithmetic, over all images, with zero tolerance and without any code of the engine.
///
/// Positions, orientations, semi-axes and box lengths are converted to `Extended` without rounding (core/extended.h:
/// long double, or the sum of two doubles where long double is short). A pair is (i, j, shift), with i = j for a
/// particle and its own image. Round particles are compared by the distance of their centres. Other pairs whose
/// circumcircles (spheres) meet are judged by the complete Vieillard-Baron criterion
/// (core/contact/ellipse_vieillard_baron.h), in three dimensions by the completed criterion of the characteristic
/// polynomial (core/contact/ellipsoid_eta.h). Both criteria also find crossed and contained overlaps.
///
/// Most pairs do not need extended arithmetic: double precision proves them to be apart, by their circumcircles or by a
/// separating axis, with a margin of more than a hundred times its rounding errors. Extended arithmetic decides all
/// pairs that double precision cannot, so the result does not depend on double precision.
///
/// With zero tolerance, every overlap counts, however small, and a touch is not an overlap. The evaluation itself has
/// rounding errors of a few hundred units of at most 2⁻⁶⁴ of the coordinates. A pair that touches exactly, or misses
/// touching by less than about 1e-17 of the largest length involved, may therefore be judged either way. That is far
/// below the spacing of the stored doubles, so whatever doubles can express about two particles is judged correctly,
/// although a state meant to touch exactly usually cannot be stored. Both extended arithmetics therefore find the same
/// overlaps (scripts/validate extended: no verdict differs on 2 · 10⁷ pairs), and their smallest gaps agree in all but
/// the last digits.
///
/// The configuration lists close pairs, which are soft particles just after a damped collision. They may overlap as
/// long as their centres are no closer than the distance stated there, and they do not count for the smallest gap.
///
/// The cost is proportional to N, since particles are sorted into cells as wide as three of the longest semi-axes. Up
/// to `brute_force_limit` particles there is a single cell, so that all pairs are tested. With the sum of two doubles,
/// a dense state takes 1.4 to 2.1 times as long as with the long double of x86 (4000 ellipses of aspect ratio 2 and 6,
/// 2000 ellipsoids).
namespace vitrel {

template <int Dim>
struct ExactCheck {
  /// All overlapping pairs in ascending order of (i, j, shift).
  std::vector<PairImage<Dim>> overlaps;
  /// The smallest distance between two surfaces, accurate to the rounding of the coordinates. If there are overlaps, it
  /// is minus the depth of the deepest, which is the length of the shortest translation that would undo it (for a
  /// crossed pair, a close upper bound of this length). It is infinity if no two surfaces are closer than the longest
  /// semi-axis in the state.
  double smallest_gap;
  /// The number of pairs (i, j, shift) whose circumcircles (spheres) meet.
  std::uint64_t pairs_examined;

  bool clean() const { return overlaps.empty(); }
};

/// Throws InvariantError if a number is not finite, if a semi-axis is not positive (in two dimensions, if 0 < b ≤ a
/// does not hold), if the norm of a quaternion is not 1, if a position or semi-axis exceeds 300 box lengths (positions
/// are stored wrapped), or if a box length is not between 1e-70 and 1e70, so that no product leaves the range of
/// doubles. Quaternions are normalised in extended arithmetic.
template <int Dim>
ExactCheck<Dim> exact_check(const Configuration<Dim>& configuration,
                            std::size_t brute_force_limit = 100);

}  // namespace vitrel
