#pragma once

#include <bit>
#include <cstdint>

#include "core/contact/free_path.h"
#include "core/contact/oriented_body.h"
#include "core/contact/round_free_path_batch.h"
#include "core/contact/sphere_batch.h"

namespace vitrel {

/// The free path of event-chain Monte Carlo for any shape: how far one body can move along x (`direction` 0), y (1) or
/// z (2), at a fixed orientation, before it touches another one that is at rest.
///
/// A path of length s along e shortens every n·d by s n·e. With the support gap g and its normal n, the path is
/// therefore free up to g/(n·e), and never ends if n·e ≤ 0. The support gap at the end of this free path gives the next
/// step. As the distance of convex bodies is a convex function of s, these are the steps of Newton's method from below:
/// they never pass the contact, and reach it, whatever the curvature of the surfaces.
///
/// Contact is declared when the surfaces are between `gap` and 1¼ `gap` apart. A pair that is already closer, and
/// approaching, touches at once. Ellipses (ellipse_free_path_batch.h), ellipsoids (ellipsoid_free_path_batch.h) and
/// round bodies (round_free_path_batch.h) have faster searches.
template <class Shape, int direction>
class PairFreePaths {
 public:
  static constexpr int Dim = Shape::dimension;
  using Body = OrientedBody<Shape>;
  using Mask = SimdBatch::Mask;

  /// `bodies` are all particles; they and `body` must outlive the search. `max_length` > 0 limits the path.
  PairFreePaths(const Body& body, const Body* bodies, double gap, double max_length)
      : body_(body),
        bodies_(bodies),
        gap_(gap),
        reach_(body.shape.circumradius() + 1.25 * gap),
        end_{max_length, FreePath::none, 0} {}

  /// Returns how far behind, aside or ahead of the moving body the centre of a particle that can end the path may be,
  /// if no circumradius exceeds `largest`.
  double reach_behind(double largest) const { return reach_ + largest; }
  double reach_aside(double largest) const { return reach_ + largest; }
  double reach_ahead(double largest) const { return end_.length + reach_ + largest; }

  /// Adds the bodies in the lanes of `mask`. The separations d are `offset` + their positions, their ids are
  /// `first_id` + lane, and group.particle holds their numbers among all bodies.
  template <class Group>
  void add(const Group& group, std::uint32_t first_id, const Vec<Dim>& offset, const Mask& mask) {
    const SimdBatch ahead = group.template coordinate<direction>() + offset[direction];
    const SimdBatch reach = group.circumradii() + reach_;
    const SimdBatch chord_squared = reach * reach - detail::aside_squared<direction>(group, offset);
    const SimdBatch half_chord = sqrt(max(chord_squared, SimdBatch(0)));
    unsigned met =
        (mask && chord_squared > 0. && ahead + half_chord > 0. && ahead - half_chord < end_.length)
            .bits();
    for (; met; met &= met - 1) {
      const int lane = std::countr_zero(met);
      search(bodies_[group.particle[lane]], first_id + static_cast<std::uint32_t>(lane),
             group.position(lane) + offset);
    }
  }

  /// Returns the free path among all bodies added.
  FreePath end() const { return end_; }

 private:
  void search(const Body& other, std::uint32_t id, const Vec<Dim>& d) {
    constexpr double tolerance = 0.25;
    Vec<Dim> now = d;
    for (double length = 0; length < end_.length;) {
      const auto [distance, normal] = support_gap(body_, other, now);
      if (normal[direction] <= 0) return;
      const double free = distance - gap_;
      if (free <= tolerance * gap_) {
        end_ = {length, id, now[direction]};
        return;
      }
      length += free / normal[direction];
      now[direction] = d[direction] - length;
    }
  }

  const Body& body_;
  const Body* bodies_;
  double gap_, reach_;
  FreePath end_;
};

}  // namespace vitrel
