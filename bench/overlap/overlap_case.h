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

/// One question to an overlap criterion: are these two disjoint?
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

/// For several aspect ratios κ, the longest semi-axis over the shortest, bodies of unit a b (c) and their likes of up
/// to twice the size; in space a quarter of them is prolate, a quarter oblate and the rest scalene:
/// - random: centres anywhere within a₁ + a₂, so crossed and contained pairs are among them;
/// - near_contact: a gap of up to ±0.1 of the gap unit;
/// - grazing: a gap of ±10⁻³ … ±10⁻¹², evenly in its logarithm.
template <int Dim>
std::vector<OverlapClass> overlap_classes();

/// Case number `index` of a class; a pure function of its arguments.
template <int Dim>
OverlapCase<Dim> make_overlap_case(const OverlapClass& of, std::uint64_t seed, std::uint64_t index);

struct OverlapTruth {
  bool disjoint = false;
  /// n·d − h₁(n) − h₂(n) along the common normal n of the bodies scaled to touch: the distance of
  /// the surfaces if they are close (negative: the depth of the overlap), otherwise its order.
  double gap = 0;
};

/// The complete criterion of Vieillard-Baron, in space that of the five signs η, in 80-bit arithmetic: right unless the
/// surfaces are closer than 1e-17 of their size. Of the criteria compared with it the one in double precision shares
/// its formula, so what is tested there is the arithmetic; the proofs of the formulas are in
/// core/contact/ellipse_vieillard_baron.h and ellipsoid_eta.h.
template <int Dim>
OverlapTruth true_overlap(const OverlapCase<Dim>& asked);

}  // namespace vitrel::bench
