#pragma once

#include "core/geometry/body.h"
#include "core/geometry/disk.h"
#include "core/geometry/ellipse.h"
#include "core/geometry/growing.h"

/// When do two bodies in free flight, perhaps growing, first touch?
///
/// Ellipses: advance along a separating axis. At time t an axis n with g(n, t) > 0 is found
/// (support gap); for this fixed n the future obeys
///     g(n, t + s) ≥ g + ġ s − ½ M s²,   M ≥ −g̈ over the step (pair_in_flight.h),
/// and the first root of the parabola is a time up to which contact is impossible. The sequence of
/// these times approaches the first contact from below: it cannot skip a contact and needs no
/// bracket.
///
/// Steps, from the time at which the circumcircles meet:
///   1. If the parabola is positive up to the end, there is no contact.
///   2. If 2 M g < ġ² up to the time −g/ġ, the gap closes at a rate that keeps its sign: Newton's
///      method leaps to the contact, in time and in the angle of n together. The same parabola from
///      there, looking back, proves that the gap was open all the way; without that proof the leap
///      is taken back.
///   3. Else step on to the root of the parabola, n turned to where it will be best.
///
/// Contact is declared at a gap within 0.75 … 1.25 of `contact_gap`, a little before the surfaces
/// meet (tolerances.h), and only while approaching: with u the speed of the surfaces, earlier than
/// the true contact by 1.25 contact_gap/u to first order. A pair that slides with its gap at that
/// level is let through by at most contact_gap/8: the step then is never shorter than
/// √(contact_gap/4M), so time always passes.
///
/// Disks and round ellipses: closed form, the same gap.
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
Prediction first_contact(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two,
                         double horizon, double contact_gap);
/// The same, beginning with an axis that is likely to separate them at the start.
Prediction first_contact(const Flight<Ellipse>& one, const Flight<Ellipse>& two, double horizon,
                         double contact_gap, const Vec2& likely_axis);
Prediction first_contact(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two,
                         double horizon, double contact_gap, const Vec2& likely_axis);
Prediction first_contact(const Flight<Disk>& one, const Flight<Disk>& two, double horizon,
                         double contact_gap);

}  // namespace vitrel
