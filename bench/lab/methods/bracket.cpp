#include "bench/lab/methods/bracket.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrel::lab {

std::optional<CircleOverlap> circle_overlap(const Vec2& d, const Vec2& v, double radius,
                                            double growth, double horizon) {
  // α t² + 2 β t + γ = 0
  const double speed = v.norm();
  const double distance = d.norm();
  const double alpha = (speed - growth) * (speed + growth);
  const double beta = d.dot(v) - radius * growth;
  const double gamma = (distance - radius) * (distance + radius);
  const double area = cross(d, v);
  const double discriminant = (radius * v - growth * d).squaredNorm() - area * area;

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
    // The other solution of the squared equation, where the sum of the radii is negative.
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

std::optional<Bracket> bracket_contact(const CollisionCase& asked) {
  const GrowingEllipse& one = asked.one.body;
  const GrowingEllipse& two = asked.two.body;
  const Vec2 d = asked.two.pose.position - asked.one.pose.position;
  const Vec2 v = asked.two.motion.velocity - asked.one.motion.velocity;

  const double outer_growth = one.growth_rate * one.shape.a + two.growth_rate * two.shape.a;
  const auto outer =
      circle_overlap(d, v, one.circumradius() + two.circumradius(), outer_growth, asked.horizon);
  if (!outer) return {};

  const double inner_growth = one.growth_rate * one.shape.b + two.growth_rate * two.shape.b;
  const auto inner =
      circle_overlap(d, v, one.inradius() + two.inradius(), inner_growth, asked.horizon);
  if (!inner) return Bracket{outer->begin, outer->end, false};
  // Rounding may put the inner time of a round pair before the outer one.
  return Bracket{std::min(outer->begin, inner->begin), inner->begin, true};
}

}  // namespace vitrel::lab
