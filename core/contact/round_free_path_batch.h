#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/contact/ellipse_batch.h"
#include "core/contact/ellipsoid_overlap_batch.h"

namespace vitrel {

/// The end of a free path.
struct FreePath {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  double length;
  std::uint32_t partner;     ///< id of the particle hit, or none
  double offset_at_contact;  ///< along the path, from the moving centre to that of the partner
};

namespace detail {

/// Coordinate k of the centres.
template <int k>
VITREL_INLINE SimdBatch coordinate(const EllipseBatch& group) {
  return (k == 0 ? group.x : group.y).load();
}
template <int k>
VITREL_INLINE SimdBatch coordinate(const EllipsoidBatch& group) {
  return (k == 0 ? group.x : k == 1 ? group.y : group.z).load();
}
VITREL_INLINE SimdBatch radii(const EllipseBatch& group) {
  return group.a.load();
}
VITREL_INLINE SimdBatch radii(const EllipsoidBatch& group) {
  return group.outer.load();
}

}  // namespace detail

/// How far can a disk or sphere move along x (`direction` 0), y (1) or z (2) before it touches others at rest, which are
/// round as well? The interface is that of ellipse_free_path_batch.h.
template <int direction, int Dim = 2>
class RoundFreePathBatch {
 public:
  using Mask = SimdBatch::Mask;

  template <class OrientedBody>
  RoundFreePathBatch(const OrientedBody& body, double gap, double max_length)
      : radius_(body.shape.circumradius() + gap), max_length_(max_length), length_(max_length) {}

  double reach_behind(double /*largest*/) const { return 0; }
  double reach_aside(double largest) const { return radius_ + largest; }
  double reach_ahead(double largest) const { return max_length_ + radius_ + largest; }

  template <class Group>
  VITREL_INLINE void add(const Group& group, std::uint32_t first_id, const Vec<Dim>& offset,
                         const Mask& mask) {
    const SimdBatch dx = detail::coordinate<direction>(group) + offset[direction];
    const SimdBatch reach = detail::radii(group) + radius_;
    const SimdBatch chord_squared = reach * reach - aside_squared(group, offset);
    const SimdBatch free_length = dx - sqrt(max(chord_squared, SimdBatch(0)));
    const Mask sooner = mask && chord_squared > 0. && dx > 0. && free_length < length_;
    length_ = select(sooner, free_length, length_);
    dx_ = select(sooner, dx, dx_);
    id_ = select(sooner, detail::lane_indices<simd_width>() + static_cast<double>(first_id), id_);
  }

  FreePath end() const {
    const double shortest = hmin(length_), length = std::max(shortest, 0.);
    const int lane = find_first_set(length_ == shortest);
    if (id_[lane] < 0) return {length, FreePath::none, 0};
    return {length, static_cast<std::uint32_t>(static_cast<double>(id_[lane])), dx_[lane] - length};
  }

 private:
  template <class Group>
  VITREL_INLINE static SimdBatch aside_squared(const Group& group, const Vec<Dim>& offset) {
    constexpr int across = (direction + 1) % Dim;
    const SimdBatch dy = detail::coordinate<across>(group) + offset[across];
    if constexpr (Dim == 2) {
      return dy * dy;
    } else {
      constexpr int up = (direction + 2) % Dim;
      const SimdBatch dz = detail::coordinate<up>(group) + offset[up];
      return dy * dy + dz * dz;
    }
  }

  double radius_, max_length_;
  SimdBatch length_, dx_{0}, id_{-1};
};

}  // namespace vitrel
