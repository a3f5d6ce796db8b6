#pragma once

#include "core/geometry/body.h"
#include "core/geometry/disk.h"
#include "core/geometry/ellipse.h"

/// When do two bodies in free flight first touch?
///
/// Ellipses: advance along a separating axis. At time t an axis n with g(n, t) > 0 is found
/// (support gap); for this fixed n the future obeys
///     g(n, t + s) ≥ g + ġ s − ½ M s²,   M ≥ max ḧ₁ + max ḧ₂ over the step,
/// and the first root of the parabola is a time up to which contact is impossible. The sequence of
/// these times approaches the first contact from below: it cannot skip a contact, needs no bracket,
/// and converges quadratically at a crossing, since the bound touches the true gap to first order.
///
/// Bound: along free flight with n fixed, ḧ = ω² h'' and h'' = a²b²/h³ − h falls with h. Over a
/// step in which the body turns by at most Δ, |u·n| = cos ψ stays ≥ cos(ψ + Δ), so h is at least
/// √(b² + (a² − b²) cos²(ψ + Δ)) (b once ψ + Δ ≥ π/2), and M follows from that smallest h. For Δ ≥
/// π/2 this is the global bound ω² (a² − b²)/b, which is attained.
///
/// Contact is declared at a gap of `contact_gap`, a little before the surfaces meet (tolerances.h),
/// and only while approaching. A pair that slides with its gap at that level is let through by at
/// most contact_gap/8: the step then is never shorter than √(contact_gap/4M), so time always
/// passes.
///
/// Disks: closed form, the same gap.
namespace vitrel {

enum class Outcome {
  contact,        ///< first touch at `time`, with `normal` and `point`
  none,           ///< no contact before the horizon
  not_converged,  ///< no contact up to `time`; ask again from there (only after very many steps)
  overlap,        ///< the bodies overlap at the start
};

/// Times count from the start of the flights, 0; the point is in their coordinates.
struct Prediction {
  Outcome outcome = Outcome::none;
  double time = 0;
  Vec2 normal = Vec2::Zero();  ///< unit vector from body 1 to body 2
  Vec2 point = Vec2::Zero();
  int steps = 0;  ///< how often the axis was sought anew
};

Prediction first_contact(const Flight<Ellipse>& one, const Flight<Ellipse>& two, double horizon,
                         double contact_gap);
Prediction first_contact(const Flight<Disk>& one, const Flight<Disk>& two, double horizon,
                         double contact_gap);

/// An upper bound of ḧ(n, s) for 0 ≤ s ≤ duration along the flight of an ellipse whose unit major
/// axis is u at s = 0 and which turns at `omega`, for the fixed unit vector n.
double support_acceleration_bound(const Ellipse& ellipse, const Vec2& u, double omega,
                                  const Vec2& n, double duration);

}  // namespace vitrel
