#include "bench/methods/ellipses/perram_wertheim_root.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/methods/first_root.h"
#include "bench/methods/opening.h"
#include "core/contact/ellipse_gap.h"

namespace vitrel::bench {
namespace {

struct Sample {
  double time;
  PerramWertheimRate f;
};

// An ellipse at one time, with the quantities that the slope needs.
struct Moving {
  Moving(const Flight<GrowingEllipse>& flight, double time) {
    const Ellipse body = body_at(flight, time);
    aa = body.a * body.a;
    bb = body.b * body.b;
    growth = flight.body.growth_rate / std::max(flight.body.size_at(time), smallest_size);
    omega = flight.motion.angular_velocity;
    u = direction(flight.pose.angle + omega * time);
  }
  Mat2 shape() const {
    const Vec2 p = perpendicular(u);
    return aa * u * u.transpose() + bb * p * p.transpose();
  }
  /// Returns yᵀ Σ̇ y.
  double shape_rate(const Vec2& y) const {
    const double along = u.dot(y);
    const double across = perpendicular(u).dot(y);
    return 2 * omega * along * across * (aa - bb) +
           2 * growth * (aa * along * along + bb * across * across);
  }

  double aa, bb, growth, omega;
  Vec2 u;
};

// The lowest point of the cubic Hermite interpolant of F between a falling and a rising sample.
struct Dip {
  double time, value;
};
Dip deepest(const Sample& before, const Sample& after) {
  const double h = after.time - before.time;
  const double rise = after.f.value - before.f.value;
  // The interpolant is p(x) = F + m₀ x + c₂ x² + c₃ x³ on 0 ≤ x ≤ 1. Its slope begins with m₀ < 0 and ends with m₁ >
  // 0.
  const double m0 = h * before.f.slope;
  const double m1 = h * after.f.slope;
  const double c2 = 3 * rise - 2 * m0 - m1;
  const double c3 = m0 + m1 - 2 * rise;
  const double root = std::sqrt(std::max(c2 * c2 - 3 * c3 * m0, 0.0));
  const double x = std::clamp(c2 + root != 0 ? -m0 / (c2 + root) : 0.5, 0.01, 0.99);
  return {before.time + x * h, before.f.value + x * (m0 + x * (c2 + x * c3))};
}

class Search {
 public:
  explicit Search(const CollisionCase& asked) : asked_(asked) {}

  std::optional<double> run(const Bracket& bracket, double fraction) {
    const int steps = scan_steps_of(fraction);
    Sample before = sample(bracket.earliest);
    if (!(before.f.value >= 1)) return before.time;
    for (int step = 1; step <= steps; ++step) {
      const Sample after = sample(bracket.sample(step, steps));
      if (const auto root = first_between(before, after)) return root;
      before = after;
    }
    if (bracket.certain) return bracket.latest;
    return {};
  }

  int evaluations() const { return evaluations_; }

 private:
  Sample sample(double time) {
    ++evaluations_;
    return {time, perram_wertheim_rate(asked_, time)};
  }

  std::optional<double> first_between(Sample before, Sample after) {
    constexpr int max_evaluations = 10;
    if (!(after.f.value >= 1)) return root_between_samples(before, after);
    for (int evaluation = 0; evaluation < max_evaluations; ++evaluation) {
      if (!(before.f.slope < 0 && after.f.slope > 0)) return {};
      const Dip dip = deepest(before, after);
      if (dip.value >= 1) return {};
      const Sample middle = sample(dip.time);
      if (!(middle.f.value >= 1)) return root_between_samples(before, middle);
      (middle.f.slope < 0 ? before : after) = middle;
    }
    return {};
  }

  double root_between_samples(const Sample& before, const Sample& after) {
    const auto excess = [&](double time) {
      ++evaluations_;
      return perram_wertheim_at(asked_, time).value - 1;
    };
    return root_between(excess, before.time, before.f.value - 1, after.time, after.f.value - 1);
  }

  const CollisionCase& asked_;
  int evaluations_ = 0;
};

}  // namespace

PerramWertheimRate perram_wertheim_rate(const CollisionCase& asked, double time) {
  const PerramWertheim<2> f = perram_wertheim_at(asked, time);
  const Moving one(asked.one, time);
  const Moving two(asked.two, time);
  const Vec2 v = asked.two.motion.velocity - asked.one.motion.velocity;
  const Vec2 d = asked.two.pose.position - asked.one.pose.position + v * time;
  const double lambda = f.lambda;
  const Mat2 c = (1 - lambda) * one.shape() + lambda * two.shape();
  const Vec2 y = c.inverse() * d;
  const double shapes = (1 - lambda) * one.shape_rate(y) + lambda * two.shape_rate(y);
  return {f.value, lambda * (1 - lambda) * (2 * v.dot(y) - shapes)};
}

Prediction2 perram_wertheim_root(const CollisionCase& asked, double tolerance) {
  const Opening opening = open_search(asked);
  if (opening.answer) return *opening.answer;
  Search search(asked);
  const auto time = search.run(opening.bracket, tolerance);
  if (!time) return without_contact(Outcome::none, search.evaluations());
  return contact_at(asked, *time, search.evaluations());
}

}  // namespace vitrel::bench
