#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/ellipse.h"

namespace vitrel::bench {

/// One question to an overlap criterion: are these two disjoint?
struct OverlapCase {
  Ellipse one, two;
  Pose2 pose1, pose2;

  Vec2 between_centres() const { return pose2.position - pose1.position; }
  double gap_unit() const { return one.b < two.b ? one.b : two.b; }
};

struct OverlapClass {
  enum class Kind { random, near_contact, grazing };
  Kind kind = Kind::random;
  std::string name;
  std::string meaning;
  double aspect_ratio = 2;
};

/// For aspect ratios 2 and 6, ellipses of area π and their likes of up to twice the size:
/// - random: centres anywhere within a₁ + a₂, so crossed and contained pairs are among them;
/// - near_contact: a gap of up to ±0.1 b;
/// - grazing: a gap of ±10⁻³ … ±10⁻¹² b, evenly in its logarithm.
std::vector<OverlapClass> overlap_classes();

/// Case number `index` of a class; a pure function of its arguments.
OverlapCase make_overlap_case(const OverlapClass& of, std::uint64_t seed, std::uint64_t index);

struct OverlapTruth {
  bool disjoint = false;
  /// n·d − h₁(n) − h₂(n) along the common normal n of the ellipses scaled to touch: the distance of
  /// the surfaces if they are close (negative: the depth of the overlap), otherwise its order.
  double gap = 0;
};

/// The complete Vieillard-Baron criterion in 80-bit arithmetic, right unless the surfaces are closer
/// than 1e-17 of their size. Of the criteria compared with it the one in double precision shares its
/// formula, so what is tested there is the arithmetic; the proof of the formula is in
/// core/contact/ellipse_vieillard_baron.h.
OverlapTruth true_overlap(const OverlapCase& asked);

}  // namespace vitrel::bench
