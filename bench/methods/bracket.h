#pragma once

#include <optional>

#include "bench/methods/collision_case.h"

namespace vitrel::bench {

/// Between which times the first contact must lie, from circles (in three dimensions spheres) alone.
///
/// Ellipses can touch only once their circumcircles do, and must once their incircles do. Circles of
/// radii Rᵢ + Γᵢt touch where |d + v t| = R + Γ t, with d, v, R, Γ the differences of the centres and
/// velocities and the sums of the radii and their rates:
///     (v² − Γ²) t² + 2 (d·v − R Γ) t + d² − R² = 0,
///     (d·v − RΓ)² − (v² − Γ²)(d² − R²) = |R v − Γ d|² − (d × v)²,
/// the right side without cancellation. |d + v t| − R − Γ t is convex in t, so that the circles
/// overlap during one interval at most. Source: woetzel2012, section 3.2.1, with growth added.
struct Bracket {
  double earliest = 0;   ///< the circumcircles touch; 0 if they overlap at the start
  double latest = 0;     ///< the incircles touch, the circumcircles part, or the horizon
  bool certain = false;  ///< the incircles touch at `latest`: there is a contact

  double duration() const { return latest - earliest; }
  /// The end of step number `step` of equal ones.
  double sample(int step, int steps) const {
    return step == steps ? latest : earliest + duration() * step / steps;
  }
};

/// Nothing if no contact is possible before the horizon.
template <int Dim>
std::optional<Bracket> bracket_contact(const CollisionCaseOf<Dim>& asked);

/// The interval of overlap of two growing circles within [0, horizon], if any.
struct CircleOverlap {
  double begin, end;
};
template <int Dim>
std::optional<CircleOverlap> circle_overlap(const Vec<Dim>& d, const Vec<Dim>& v, double radius,
                                            double growth, double horizon);

}  // namespace vitrel::bench
