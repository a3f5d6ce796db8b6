#pragma once

#include <optional>

#include "bench/methods/collision_case.h"

namespace vitrel::bench {

/// The interval in which the first contact must lie, according to circles (in three dimensions spheres) alone.
///
/// Ellipses cannot touch before their circumcircles do, and must touch once their incircles do. Circles of radii Rᵢ +
/// Γᵢt touch when |d + v t| = R + Γ t, with the differences d and v of the centres and velocities and the sums R and
/// Γ of the radii and growth rates:
///     (v² − Γ²) t² + 2 (d·v − R Γ) t + d² − R² = 0,
///     (d·v − RΓ)² − (v² − Γ²)(d² − R²) = |R v − Γ d|² − (d × v)²,
/// where the right side of the second equation has no cancellation. |d + v t| − R − Γ t is convex in t, so the
/// circles overlap during one interval at most. Source: woetzel2012, section 3.2.1, with growth added.
struct Bracket {
  double earliest = 0;   ///< the circumcircles begin to touch; 0 if they overlap at the start
  double latest = 0;     ///< the incircles touch, the circumcircles separate, or the horizon
  bool certain = false;  ///< the incircles touch at `latest`, so there is a contact

  double duration() const { return latest - earliest; }
  /// The end of step number `step` out of `steps` equal ones.
  double sample(int step, int steps) const {
    return step == steps ? latest : earliest + duration() * step / steps;
  }
};

/// Returns no value if no contact is possible before the horizon.
template <int Dim>
std::optional<Bracket> bracket_contact(const CollisionCaseOf<Dim>& asked);

/// The interval within [0, horizon] in which two growing circles overlap, if any.
struct CircleOverlap {
  double begin, end;
};
template <int Dim>
std::optional<CircleOverlap> circle_overlap(const Vec<Dim>& d, const Vec<Dim>& v, double radius,
                                            double growth, double horizon);

}  // namespace vitrel::bench
