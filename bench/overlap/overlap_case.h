#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/ellipse.h"
#include "core/geometry/ellipsoid.h"

namespace vitrel::bench {

template <int Dim>
using BodyIn = std::conditional_t<Dim == 2, Ellipse, Ellipsoid>;
template <int Dim>
using PoseIn = std::conditional_t<Dim == 2, Pose2, Pose3>;

/// The input of an overlap criterion: two bodies, which may be disjoint.
template <int Dim>
struct OverlapCase {
  BodyIn<Dim> one, two;
  PoseIn<Dim> pose1, pose2;

  Vec<Dim> between_centres() const { return pose2.position - pose1.position; }
  /// The smaller of the shortest semi-axes.
  double gap_unit() const { return std::min(one.inradius(), two.inradius()); }
};

struct OverlapClass {
  enum class Kind { random, near_contact, grazing };
  Kind kind = Kind::random;
  std::string name;
  double aspect_ratio = 2;
};

/// Classes for several aspect ratios κ (longest over shortest semi-axis), with bodies of unit a b (c) and similar
/// bodies of up to twice the size. In space a quarter of them is prolate, a quarter oblate, and the rest scalene.
/// - random: centres lie anywhere within a₁ + a₂, so that some pairs are crossed or contain each other;
/// - near_contact: gaps are up to ±0.1 of the gap unit;
/// - grazing: gaps are ±10⁻³ … ±10⁻¹² of it, uniform in their logarithm.
template <int Dim>
std::vector<OverlapClass> overlap_classes();

/// Case number `index` of a class. It is a pure function of its arguments.
template <int Dim>
OverlapCase<Dim> make_overlap_case(const OverlapClass& of, std::uint64_t seed, std::uint64_t index);

struct OverlapTruth {
  bool disjoint = false;
  /// n·d − h₁(n) − h₂(n) along the common normal n of the bodies scaled until they touch. If the surfaces are close,
  /// this is their distance (negative: minus the depth of the overlap); otherwise it has the order of the distance.
  double gap = 0;
};

/// The answer by the complete criterion of Vieillard-Baron, in space that of the five signs η, in 80-bit arithmetic.
/// It is right unless the surfaces are closer than 1e-17 of their size. The criterion in double precision that is
/// compared with it shares its formula, so that comparison tests the arithmetic. The formulas are proved in
/// core/contact/ellipse_vieillard_baron.h and ellipsoid_eta.h.
template <int Dim>
OverlapTruth true_overlap(const OverlapCase<Dim>& asked);

}  // namespace vitrel::bench
