#include "bench/methods/bracket.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrel::bench {

namespace {

double square(double x) {
  return x * x;
}
double square(const Vec3& v) {
  return v.squaredNorm();
}

}  // namespace

template <int Dim>
std::optional<CircleOverlap> circle_overlap(const Vec<Dim>& d, const Vec<Dim>& v, double radius,
                                            double growth, double horizon) {
  // Solves α t² + 2 β t + γ = 0.
  const double speed = v.norm();
  const double distance = d.norm();
  const double alpha = (speed - growth) * (speed + growth);
  const double beta = d.dot(v) - radius * growth;
  const double gamma = (distance - radius) * (distance + radius);
  const double discriminant = (radius * v - growth * d).squaredNorm() - square(cross(d, v));

  double begin = 0;
  if (gamma > 0) {
    if (!(discriminant >= 0)) return {};
    const double root = std::sqrt(discriminant);
    if (beta < 0)
      begin = gamma / (root - beta);
    else if (alpha < 0)
      begin = -(beta + root) / alpha;
    else
      return {};
    // This is the other solution of the squared equation, at which the sum of the radii is negative.
    if (radius + growth * begin < 0) return {};
  }
  if (!(begin <= horizon)) return {};

  const double root = std::sqrt(std::max(discriminant, 0.0));
  double end = std::numeric_limits<double>::infinity();
  if (beta > 0)
    end = -gamma / (beta + root);
  else if (alpha > 0)
    end = (root - beta) / alpha;
  if (gamma > 0 && alpha <= 0) end = std::numeric_limits<double>::infinity();
  return CircleOverlap{begin, std::clamp(end, begin, horizon)};
}

template <int Dim>
std::optional<Bracket> bracket_contact(const CollisionCaseOf<Dim>& asked) {
  const GrowingBody<Dim>& one = asked.one.body;
  const GrowingBody<Dim>& two = asked.two.body;
  const Vec<Dim> d = asked.two.pose.position - asked.one.pose.position;
  const Vec<Dim> v = asked.two.motion.velocity - asked.one.motion.velocity;

  const double outer_growth =
      one.growth_rate * one.shape.circumradius() + two.growth_rate * two.shape.circumradius();
  const auto outer = circle_overlap<Dim>(d, v, one.circumradius() + two.circumradius(),
                                         outer_growth, asked.horizon);
  if (!outer) return {};

  const double inner_growth =
      one.growth_rate * one.shape.inradius() + two.growth_rate * two.shape.inradius();
  const auto inner =
      circle_overlap<Dim>(d, v, one.inradius() + two.inradius(), inner_growth, asked.horizon);
  if (!inner) return Bracket{outer->begin, outer->end, false};
  // Rounding may put the inner time of a round pair before its outer time.
  return Bracket{std::min(outer->begin, inner->begin), inner->begin, true};
}

template std::optional<CircleOverlap> circle_overlap(const Vec2&, const Vec2&, double, double,
                                                     double);
template std::optional<Bracket> bracket_contact(const CollisionCase&);
template std::optional<Bracket> bracket_contact(const EllipsoidCase&);

}  // namespace vitrel::bench
