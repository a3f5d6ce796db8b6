#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/ellipse_pair.h"
#include "core/contact/ellipsoid_pair.h"

/// @file
/// Newton's method for the axis n that maximises the support gap g of two bodies (ellipse_gap.h, ellipsoid_gap.h).
namespace vitrel {

template <int Dim>
struct SupportGapOf {
  double
      gap;  ///< the distance if positive; otherwise the bodies touch or overlap, and only the sign counts
  /// The unit vector from 1 to 2 that is normal to the surfaces at the closest points; for an overlapping pair, at the
  /// point where the bodies touch when they are scaled about their centres.
  Vec<Dim> normal;
};
using SupportGap = SupportGapOf<2>;
using SupportGap3 = SupportGapOf<3>;

namespace detail {

inline const Vec2& normal_of(const Vec2& axis) {
  return axis;
}
inline Vec3 normal_of(const Axis3& axis) {
  return vector(axis.n);
}

/// Returns the unit vector n rotated by `angle`, to third order.
inline Vec2 turned(const Vec2& n, double angle) {
  const double q = 0.5 * angle;
  const double scale = 1 / (1 + q * q);
  return (1 - q * q) * scale * n + angle * scale * perpendicular(n);
}
/// Returns the axis rotated by a step in its tangent plane.
inline Axis3 turned(const Axis3& axis, const Tangent& step) {
  const double q = 0.5 * norm(step);
  const double scale = 1 / (1 + q * q);
  const Vec3 n = (1 - q * q) * scale * vector(axis.n) +
                 scale * (step[0] * vector(axis.e1) + step[1] * vector(axis.e2));
  return completed(components(n));
}

inline double clamped(double turn, double most) {
  return std::clamp(turn, -most, most);
}
inline Tangent clamped(const Tangent& step, double longest) {
  const double length = norm(step);
  return length <= longest ? step : Tangent(longest / length * step);
}

/// Returns C(λ)⁻¹d for the λ at which λ : 1 − λ is the ratio of the radii along d. This is the best axis for circles,
/// and a good one while the bodies are not close. It need not separate them.
Vec2 initial_axis(const EllipsePair& pair);
Axis3 initial_axis(const EllipsoidPair& pair);

/// The first separating axis C(λ)⁻¹d found while maximising F(λ) from the λ of initial_axis. For an overlapping pair it
/// is the axis at the maximum of F, which is the common normal of the bodies scaled to touch.
template <class Axis>
struct SeparatingAxis {
  Axis n;
  bool separates;
};
SeparatingAxis<Vec2> find_separating_axis(const EllipsePair& pair);
SeparatingAxis<Axis3> find_separating_axis(const EllipsoidPair& pair);

/// Moves n by one damped Newton step towards the maximum of g. `here` is gap_along at n, before and after the step.
/// Returns false, and changes nothing, if no step improves g.
template <class Pair, class Axis>
[[gnu::noinline]] bool improve_axis(const Pair& pair, Axis& n, decltype(gap_along(pair, n))& here) {
  // A gain below the rounding of g = n·d − h₁ − h₂ would have no effect.
  constexpr double negligible = 1e-17;
  if (!here.is_concave() || here.gain() < negligible * dot(normal_of(n), pair.d)) return false;
  auto turn = here.newton();
  for (int halving = 0; halving < 30; ++halving, turn *= 0.25) {
    const Axis trial = turned(n, turn);
    const auto there = gap_along(pair, trial);
    if (there.gap > here.gap) {
      n = trial;
      here = there;
      return true;
    }
  }
  return false;
}

// improve_axis is compiled separately: if it were compiled with the search for contacts, which seldom needs it, that
// search would take 2 % more instructions.
extern template bool improve_axis(const EllipsePair&, Vec2&, GapAlongAxis&);
extern template bool improve_axis(const EllipsoidPair&, Axis3&, GapAlongAxis3&);

/// Solves ∇g = 0 by Newton's method from an axis that maximises g to rounding. g is flat at its maximum, so such an
/// axis is accurate to √ε only; the gradient makes it accurate to ε.
template <class Pair, class Axis>
void polish_axis(const Pair& pair, Axis& n, const decltype(gap_along(pair, n))& here) {
  constexpr int max_steps = 4;
  constexpr double quadratic = 3e-8;  // after such a step the error is below rounding
  if (!here.is_concave()) return;
  auto turn = here.newton();
  n = turned(n, turn);
  for (int step = 1; step < max_steps && !(norm(turn) < quadratic); ++step) {
    const auto now = gap_along(pair, n);
    if (!now.is_concave()) return;
    turn = now.newton();
    n = turned(n, turn);
  }
}

/// Repeats improve_axis until the gap along n is at least `enough` or at its maximum, and returns it.
template <class Pair, class Axis>
auto improved_gap(const Pair& pair, Axis& n, double enough) {
  constexpr int max_steps = 60;
  auto here = gap_along(pair, n);
  for (int step = 0; here.gap < enough && step < max_steps; ++step)
    if (!improve_axis(pair, n, here)) break;
  return here;
}

/// Returns the largest support gap.
template <class Pair>
auto largest_gap(const Pair& pair) -> SupportGapOf<decltype(pair.d)::SizeAtCompileTime> {
  auto [n, separates] = find_separating_axis(pair);
  if (!separates) return {std::min(0.0, gap_along(pair, n).gap), normal_of(n)};
  const auto here = improved_gap(pair, n, std::numeric_limits<double>::infinity());
  polish_axis(pair, n, here);
  return {here.gap, normal_of(n)};
}

/// Returns whether two bodies at the distance d are at least `margin` apart. Calls `make_pair` only if their radii do
/// not decide.
template <class Body>
bool are_separated(const Body& one, const Body& two, const auto& d, double margin,
                   const auto& make_pair) {
  const double distance_squared = squared_norm(d);
  const double outer = one.circumradius() + two.circumradius() + margin;
  if (distance_squared >= outer * outer) return true;
  const double inner = one.inradius() + two.inradius() + margin;
  if (distance_squared < inner * inner) return false;
  const auto pair = make_pair();
  auto [n, separates] = find_separating_axis(pair);
  return separates && improved_gap(pair, n, margin).gap >= margin;
}

}  // namespace detail
}  // namespace vitrel
