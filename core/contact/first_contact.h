#pragma once

#include "core/geometry/ball.h"
#include "core/geometry/body.h"
#include "core/geometry/ellipse.h"
#include "core/geometry/growing.h"

/// @file
/// The time at which two bodies in free flight, possibly growing, first touch.
///
/// For ellipses the method is conservative advancement along a separating axis. At time t the search finds an axis n
/// with g(n, t) > 0 (support gap). For this fixed n
///
///     g(n, t + s) ≥ g + ġ s − ½ M s²,   M ≥ −g̈ over the step (ellipse_pair_in_flight.h),
///
/// and the first root of the parabola is a time before which contact is impossible. These times approach the
/// first contact from below: the search cannot skip a contact and needs no bracket.
///
/// The steps start at the time at which the circumcircles touch:
///   1. If the parabola is positive up to the end, there is no contact.
///   2. If, to second order, the gap along the best axis reaches zero with at least half of the square of its rate,
///      Newton's method finds the contact, in time and in the angle of n together. The parabola taken backwards from
///      there proves that the gap was open all the way; without this proof the Newton step is discarded.
///   3. Otherwise, the search advances to the root of the parabola and rotates n to its predicted optimum.
///
/// Contact is declared at a gap of 0.75 … 1.25 `contact_gap`, slightly before the surfaces meet (tolerances.h), and
/// only while they approach. With u the speed of the surfaces, it comes earlier than the true contact by at most 1.25
/// contact_gap/u to first order. A pair that slides at this gap loses at most contact_gap/8: the step is never shorter
/// than √(contact_gap/4M), so time always advances.
///
/// In three dimensions, two coordinates on the sphere replace the angle of n.
///
/// Disks, spheres, and pairs of which both are round are solved in closed form, with the same contact gap.
namespace vitrel {

enum class Outcome {
  contact,        ///< first touch at `time`, with `normal` and `point`
  none,           ///< no contact before the horizon
  not_converged,  ///< no contact up to `time`; call again from there (only after very many steps)
  overlap,        ///< the bodies overlap at the start
};

/// Times are relative to the start of the flights; the point is in their coordinates.
template <int Dim>
struct Prediction {
  Outcome outcome = Outcome::none;
  double time = 0;
  Vec<Dim> normal = Vec<Dim>::Zero();  ///< unit vector from body 1 to body 2
  Vec<Dim> point = Vec<Dim>::Zero();
  int steps = 0;  ///< number of axes tried
};
using Prediction2 = Prediction<2>;
using Prediction3 = Prediction<3>;

/// Instantiated for Disk, Ellipse, GrowingEllipse, Sphere, GrowingSphere, Ellipsoid, GrowingEllipsoid and
/// TumblingEllipsoid.
template <Body B>
Prediction<B::dimension> first_contact(const Flight<B>& one, const Flight<B>& two, double horizon,
                                       double contact_gap);

/// A time and an axis with which a search may begin.
template <int Dim>
struct SearchStart {
  double time;    ///< the bodies are disjoint until this time
  Vec<Dim> axis;  ///< probably separates the bodies
};
/// Starts the search at `start`. Instantiated for all these bodies but disks and spheres.
template <Body B>
Prediction<B::dimension> first_contact(const Flight<B>& one, const Flight<B>& two, double horizon,
                                       double contact_gap, const SearchStart<B::dimension>& start);

}  // namespace vitrel
