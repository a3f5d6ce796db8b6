#pragma once

#include "core/geometry/body.h"
#include "core/geometry/disk.h"
#include "core/geometry/ellipse.h"
#include "core/geometry/growing.h"
#include "core/geometry/sphere.h"

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
/// In three dimensions the angle of n becomes two coordinates on the sphere, and all else stays.
///
/// Disks, spheres, and pairs that are both round: closed form, the same gap.
namespace vitrel {

enum class Outcome {
  contact,        ///< first touch at `time`, with `normal` and `point`
  none,           ///< no contact before the horizon
  not_converged,  ///< no contact up to `time`; ask again from there (only after very simd_width steps)
  overlap,        ///< the bodies overlap at the start
};

/// Times count from the start of the flights, 0; the point is in their coordinates.
template <int Dim>
struct Prediction {
  Outcome outcome = Outcome::none;
  double time = 0;
  Vec<Dim> normal = Vec<Dim>::Zero();  ///< unit vector from body 1 to body 2
  Vec<Dim> point = Vec<Dim>::Zero();
  int steps = 0;  ///< how often the axis was sought anew
};
using Prediction2 = Prediction<2>;
using Prediction3 = Prediction<3>;

/// Disk, Ellipse, GrowingEllipse; Sphere, Ellipsoid, GrowingEllipsoid.
template <Body B>
Prediction<B::dimension> first_contact(const Flight<B>& one, const Flight<B>& two, double horizon,
                                       double contact_gap);
/// The same, not for round bodies, beginning with an axis that is likely to separate them at the start.
template <Body B>
Prediction<B::dimension> first_contact(const Flight<B>& one, const Flight<B>& two, double horizon,
                                       double contact_gap, const Vec<B::dimension>& initial_axis);

}  // namespace vitrel
