#pragma once

#include "bench/surveys/stability_suite.h"

namespace vitrel::bench {

/// The classes of pairs of ellipsoids; those that make sense at any aspect ratio κ, the longest semi-axis
/// over the shortest, once for 2 and once for 10. A quarter of the bodies is prolate and a quarter oblate,
/// the rest scalene.
std::vector<CaseClassOf<3>> ellipsoid_suite();

/// Two ellipsoids with parallel axes, (2, 1, 1.2) and (1.5, 1, 0.8), the second of which passes the first
/// at (3 − t, 2 − depth, 0) without turning: they overlap shortly about t = 3, where they are `depth`
/// deep. The flatter their tops, the longer: with the radii of curvature ρ = 2² and 1.5² along the flight
/// for
///     2 √(2 depth (ρ₁ + ρ₂)) = √(50 depth)
/// to first order, a short time beside the bracket of some five units.
EllipsoidCase passing_pair(double depth);

}  // namespace vitrel::bench
