#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/methods/collision_case.h"

namespace vitrel::bench {

/// A class of cases, generated from a seed.
template <int Dim>
struct CaseClassOf {
  std::string name;  ///< for example "grazing"
  /// The larger aspect ratio of the pairs. Classes that draw aspect ratios draw them from 1 to this value.
  double aspect_ratio = 2;
  /// Makes case number `index`. It is a pure function of its arguments, which any thread may call.
  std::function<CollisionCaseOf<Dim>(std::uint64_t seed, std::uint64_t index)> make;
};
using CaseClass = CaseClassOf<2>;

/// All classes of the stability suite; on each of them some method fails. Classes that make sense at any aspect ratio
/// κ (longest over shortest semi-axis) occur at two of them. stability_suite.cpp says what the cases of each class
/// have in common. In space a quarter of the bodies is prolate, a quarter oblate, and the rest scalene.
template <int Dim = 2>
std::vector<CaseClassOf<Dim>> stability_suite();

template <int Dim>
CollisionCaseOf<Dim> make_case(const CaseClassOf<Dim>& of, std::uint64_t seed,
                               std::uint64_t index) {
  return of.make(seed, index);
}

/// Two ellipsoids with parallel axes, (2, 1, 1.2) and (1.5, 1, 0.8), the second of which passes the first at (3 − t,
/// 2 − depth, 0) without turning. They overlap for a short time about t = 3, when the depth of the overlap is
/// `depth`. The flatter their tops, the longer it lasts: with the radii of curvature ρ = 2² and 1.5² along the flight
/// it lasts
///     2 √(2 depth (ρ₁ + ρ₂)) = √(50 depth)
/// to first order, which is short compared with the bracket of about five units.
EllipsoidCase passing_pair(double depth);

}  // namespace vitrel::bench
