#pragma once

#include <algorithm>
#include <cmath>

#include "core/contact/ellipse_pair.h"

/// @file
/// The support gap of two ellipses. For a unit vector n, g(n) = n·d − h₁(n) − h₂(n) with the support functions
/// h(n) = √(b² + (a² − b²)(u·n)²), u along the major axis and d from centre 1 to centre 2. If g(n) > 0, n separates
/// the ellipses. max g is their distance, attained at the normal of the closest points.
///
/// Along the angle φ of n, g'' = −(g + ρ₁ + ρ₂), where ρ = a²b²/h³ is the radius of curvature at the point with
/// normal n. On the arc with g > 0, g is strictly concave, and Newton's method in φ converges quadratically to the
/// only maximum. The Perram–Wertheim function (1985), F(λ) = λ(1−λ) dᵀC⁻¹d with C = (1−λ)Σ₁ + λΣ₂, gives a start on
/// that arc: where F(λ) > 1, the direction C⁻¹d separates (Cauchy–Schwarz), and max F > 1 exactly for disjoint
/// ellipses.
namespace vitrel {

/// Support function of an ellipse with unit major axis u along the unit vector n.
inline double support(const Ellipse& ellipse, const Vec2& u, const Vec2& n) {
  const double along = dot(u, n);
  return std::sqrt(ellipse.b * ellipse.b + ellipse.aa_minus_bb() * along * along);
}

struct SupportGap {
  double
      gap;  ///< the distance if positive; otherwise the bodies touch or overlap, and only the sign counts
  /// Unit vector from 1 to 2: the normal of the closest points; of an overlapping pair, of the
  /// ellipses scaled about their centres to touch.
  Vec2 normal;
};

/// The largest support gap, to rounding, for ellipses with unit major axes u1 and u2.
SupportGap support_gap(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
                       const Vec2& d);
/// The same for angles of the major axes.
SupportGap support_gap(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                       const Vec2& d);

/// True if and only if an axis with g ≥ margin exists (margin ≥ 0; to rounding): the surfaces are at least
/// `margin` apart. Returns as soon as one axis proves it; tests the circles first.
bool separated(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
               const Vec2& d, double margin);

/// The point of the first ellipse's surface with outward unit normal n, relative to its centre.
inline Vec2 surface_point(const Ellipse& ellipse, const Vec2& u, const Vec2& n) {
  const Vec2 sigma_n = ellipse.b * ellipse.b * n + ellipse.aa_minus_bb() * dot(u, n) * u;
  return sigma_n / support(ellipse, u, n);
}

namespace detail {

/// The unit vector n rotated by `angle`, to third order.
inline Vec2 turned(const Vec2& n, double angle) {
  const double q = 0.5 * angle;
  const double scale = 1 / (1 + q * q);
  return (1 - q * q) * scale * n + angle * scale * perpendicular(n);
}

inline double clamped(double turn, double most) {
  return std::clamp(turn, -most, most);
}

/// C(λ)⁻¹d with λ : 1 − λ in the ratio of the radii along d: the best axis for circles, and a good one while the
/// bodies are not close. It need not separate them.
Vec2 initial_axis(const EllipsePair& pair);

/// The first separating axis C(λ)⁻¹d found while maximising F(λ) from there; for an overlapping pair the axis at
/// the maximum of F, which is the common normal of the ellipses scaled to touch.
struct SeparatingAxis {
  Vec2 n;
  bool separates;
};
SeparatingAxis find_separating_axis(const EllipsePair& pair);

/// One damped Newton step of n towards the maximum of g. `here` is gap_along at n, before and after. Returns
/// false, and changes nothing, if no step improves g.
bool improve_axis(const EllipsePair& pair, Vec2& n, GapAlongAxis& here);

/// Newton iteration on dg/dφ = 0 from an axis that maximises g to rounding. g is flat at its maximum, so such an
/// axis is accurate to √ε only; the slope makes it accurate to ε.
inline void polish_axis(const EllipsePair& pair, Vec2& n, const GapAlongAxis& here) {
  constexpr int max_steps = 4;
  constexpr double quadratic = 3e-8;  // after such a step the error is below rounding
  if (!(here.curvature > 0)) return;
  double turn = here.slope / here.curvature;
  n = turned(n, turn);
  for (int step = 1; step < max_steps && !(std::abs(turn) < quadratic); ++step) {
    const GapAlongAxis now = gap_along(pair, n);
    if (!(now.curvature > 0)) return;
    turn = now.slope / now.curvature;
    n = turned(n, turn);
  }
}

}  // namespace detail
}  // namespace vitrel
