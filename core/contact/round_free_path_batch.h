#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/contact/free_path.h"
#include "core/contact/simd_batch.h"

namespace vitrel {

namespace detail {

/// Returns the squared distances of the centres from a path along x (`direction` 0), y (1) or z (2) through the origin.
template <int direction, class Group, class Offset>
VITREL_INLINE SimdBatch aside_squared(const Group& group, const Offset& offset) {
  constexpr int dimension = Offset::RowsAtCompileTime;
  constexpr int across = (direction + 1) % dimension;
  const SimdBatch dy = group.template coordinate<across>() + offset[across];
  if constexpr (dimension == 2) {
    return dy * dy;
  } else {
    constexpr int up = (direction + 2) % dimension;
    const SimdBatch dz = group.template coordinate<up>() + offset[up];
    return dy * dy + dz * dz;
  }
}

}  // namespace detail

/// The free path of event-chain Monte Carlo for disks and spheres: how far one of them can move along x (`direction`
/// 0), y (1) or z (2) before it touches others at rest, which are round as well. The interface is that of
/// ellipse_free_path_batch.h.
template <int direction, int Dim>
class RoundFreePathBatch {
 public:
  using Mask = SimdBatch::Mask;

  template <class Body>
  RoundFreePathBatch(const Body& body, const Body* /*bodies*/, double gap, double max_length)
      : radius_(body.shape.circumradius() + gap), max_length_(max_length), length_(max_length) {}

  double reach_behind(double /*largest*/) const { return 0; }
  double reach_aside(double largest) const { return radius_ + largest; }
  double reach_ahead(double largest) const { return max_length_ + radius_ + largest; }

  template <class Group>
  VITREL_INLINE void add(const Group& group, std::uint32_t first_id, const Vec<Dim>& offset,
                         const Mask& mask) {
    const SimdBatch dx = group.template coordinate<direction>() + offset[direction];
    const SimdBatch reach = group.circumradii() + radius_;
    const SimdBatch chord_squared = reach * reach - detail::aside_squared<direction>(group, offset);
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
  double radius_, max_length_;
  SimdBatch length_, dx_{0}, id_{-1};
};

}  // namespace vitrel
