#pragma once

#include <bit>
#include <cstdint>

#include "core/contact/oriented_body.h"
#include "core/contact/sphere_batch.h"

namespace vitrel {

/// The overlap test of trial moves for any shape: whether one body keeps a margin to all of several others at rest.
/// Circumspheres a margin apart prove the pair separated, overlapping inspheres prove an overlap, and separated()
/// (oriented_body.h) decides all other pairs one by one. Ellipses (ellipse_overlap_batch.h) and ellipsoids
/// (ellipsoid_overlap_batch.h) have faster tests with the same answers.
template <class Shape>
class PairOverlaps {
 public:
  static constexpr int Dim = Shape::dimension;
  using Body = OrientedBody<Shape>;
  /// A set of lanes: bit k is lane k.
  using Lanes = unsigned;

  /// `bodies` are all particles; they and `body` must outlive the test. Requires margin ≥ 0.
  PairOverlaps(const Body& body, const Body* bodies, double margin)
      : body_(body), bodies_(bodies), margin_(margin) {}

  /// Returns false if the body is closer than the margin to one of the bodies in these lanes. The separations d are
  /// `offset` + their positions, and group.particle holds their numbers among all bodies. Adds the number of pairs that
  /// separated() decided to `scalar_tests`.
  template <class Group>
  bool may_be_clear_of(const Group& group, const Vec<Dim>& offset, Lanes lanes,
                       std::uint64_t& scalar_tests) const {
    const SimdBatch square = group.squared_distances(offset);
    const SimdBatch outer = group.circumradii() + (body_.shape.circumradius() + margin_);
    Lanes undecided = lanes & (square < outer * outer).bits();
    const SimdBatch inner = group.inner.load() + body_.shape.inradius();
    if (undecided & (square < inner * inner).bits()) return false;
    for (; undecided; undecided &= undecided - 1) {
      const int lane = std::countr_zero(undecided);
      ++scalar_tests;
      if (!separated(body_, bodies_[group.particle[lane]], group.position(lane) + offset, margin_))
        return false;
    }
    return true;
  }

  /// No pairs wait for a full batch, so the answer is always yes.
  bool rest_is_clear(std::uint64_t& /*scalar_tests*/) const { return true; }

 private:
  const Body& body_;
  const Body* bodies_;
  double margin_;
};

}  // namespace vitrel
