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
  std::string name;  ///< "grazing"
  /// The larger aspect ratio of the pairs; classes that draw it draw from 1 to this.
  double aspect_ratio = 2;
  /// Case number `index`; a pure function of its arguments that any thread may call.
  std::function<CollisionCaseOf<Dim>(std::uint64_t seed, std::uint64_t index)> make;
};
using CaseClass = CaseClassOf<2>;

/// All classes of the stability suite, each of which some method fails on; those that make sense at any aspect ratio κ,
/// the longest semi-axis over the shortest, at two of them. stability_suite.cpp says of each class what its cases have
/// in common. In space a quarter of the bodies is prolate and a quarter oblate, the rest scalene.
template <int Dim = 2>
std::vector<CaseClassOf<Dim>> stability_suite();

template <int Dim>
CollisionCaseOf<Dim> make_case(const CaseClassOf<Dim>& of, std::uint64_t seed,
                               std::uint64_t index) {
  return of.make(seed, index);
}

/// Two ellipsoids with parallel axes, (2, 1, 1.2) and (1.5, 1, 0.8), the second of which passes the first
/// at (3 − t, 2 − depth, 0) without turning: they overlap shortly about t = 3, where they are `depth`
/// deep. The flatter their tops, the longer: with the radii of curvature ρ = 2² and 1.5² along the flight
/// for
///     2 √(2 depth (ρ₁ + ρ₂)) = √(50 depth)
/// to first order, a short time beside the bracket of some five units.
EllipsoidCase passing_pair(double depth);

}  // namespace vitrel::bench
