#include "core/contact/support_gap.h"

#include <algorithm>
#include <cmath>

namespace vitrel {

Vec2 direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

namespace {

double stretch(const Ellipse& ellipse) {
  return (ellipse.a - ellipse.b) * (ellipse.a + ellipse.b);
}

struct SupportAlong {
  double height;  // h
  double slope;   // dh/dφ
  double radius;  // radius of curvature h + h''
};

SupportAlong support_along(const Ellipse& ellipse, const Vec2& u, const Vec2& n) {
  const double along = u.dot(n);
  const double across = cross(n, u);  // u · dn/dφ
  const double e = stretch(ellipse);
  const double h = std::sqrt(ellipse.b * ellipse.b + e * along * along);
  const double ab = ellipse.a * ellipse.b;
  return {h, e * along * across / h, ab * ab / (h * h * h)};
}

// F(λ) in two dimensions needs no inverse: with w_i = adj(Σ_i) d and μ = 1 − λ,
// F = λμ (μ p₁ + λ p₂)/(μ² D₁ + λμ M + λ² D₂), p_i = d·w_i, D_i = det Σ_i, M = tr(adj(Σ₁) Σ₂).
struct PerramWertheimRatio {
  Vec2 w1, w2;
  double p1, p2, det1, det2, mixed;

  PerramWertheimRatio(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
                      const Vec2& d)
      : w1(adjugate_times(one, u1, d)), w2(adjugate_times(two, u2, d)) {
    p1 = d.dot(w1);
    p2 = d.dot(w2);
    const double a1 = one.a * one.a, b1 = one.b * one.b;
    const double a2 = two.a * two.a, b2 = two.b * two.b;
    det1 = a1 * b1;
    det2 = a2 * b2;
    const double s = cross(u1, u2);
    mixed = b1 * a2 + a1 * b2 + stretch(one) * stretch(two) * s * s;
  }

  static Vec2 adjugate_times(const Ellipse& e, const Vec2& u, const Vec2& d) {
    const Vec2 across = perpendicular(u);
    return e.b * e.b * u.dot(d) * u + e.a * e.a * across.dot(d) * across;
  }

  // C⁻¹d up to a positive factor.
  Vec2 axis(double lambda) const { return (1 - lambda) * w1 + lambda * w2; }

  // Signs of F − 1 and of dF/dλ, and the Newton step of dF/dλ = 0, from numerator and denominator.
  struct Point {
    bool above_one;
    double slope;  // same sign as dF/dλ
    double newton_step;
  };
  Point at(double lambda) const {
    const double mu = 1 - lambda;
    const double p = mu * p1 + lambda * p2;
    const double dp = p2 - p1;
    const double top = lambda * mu * p;
    const double dtop = (mu - lambda) * p + lambda * mu * dp;
    const double ddtop = -2 * p + 2 * (mu - lambda) * dp;
    const double bottom = mu * mu * det1 + lambda * mu * mixed + lambda * lambda * det2;
    const double dbottom = -2 * mu * det1 + (mu - lambda) * mixed + 2 * lambda * det2;
    const double ddbottom = 2 * (det1 - mixed + det2);
    const double slope = dtop * bottom - top * dbottom;
    const double dslope = ddtop * bottom - top * ddbottom;
    return {top > bottom, slope, -slope / dslope};
  }
};

constexpr int max_lambda_steps = 100;
constexpr int max_newton_steps = 60;

}  // namespace

double support(const Ellipse& ellipse, const Vec2& u, const Vec2& n) {
  const double along = u.dot(n);
  return std::sqrt(ellipse.b * ellipse.b + stretch(ellipse) * along * along);
}

Vec2 surface_point(const Ellipse& ellipse, const Vec2& u, const Vec2& n) {
  const Vec2 sigma_n = ellipse.b * ellipse.b * n + stretch(ellipse) * u.dot(n) * u;
  return sigma_n / support(ellipse, u, n);
}

namespace detail {

GapAlongAxis gap_along(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
                       const Vec2& d, const Vec2& n) {
  const SupportAlong h1 = support_along(one, u1, n);
  const SupportAlong h2 = support_along(two, u2, n);
  const double gap = n.dot(d) - h1.height - h2.height;
  const double slope = cross(n, d) - h1.slope - h2.slope;
  return {gap, slope, gap + h1.radius + h2.radius, h1.slope, h2.slope};
}

Vec2 find_separating_axis(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
                          const Vec2& d) {
  const PerramWertheimRatio f(one, u1, two, u2, d);
  // Exact for circles: λ : μ as the radii of the two ellipses along d.
  const double r1 = std::sqrt(f.det1 * f.p2), r2 = std::sqrt(f.det2 * f.p1);
  double lambda = r1 + r2 > 0 ? r1 / (r1 + r2) : 0.5;
  double low = 0, high = 1;
  for (int step = 0; step < max_lambda_steps; ++step) {
    const auto here = f.at(lambda);
    if (here.above_one) return f.axis(lambda).normalized();
    (here.slope > 0 ? low : high) = lambda;
    double next = lambda + here.newton_step;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - lambda) <= 1e-15 * lambda) break;
    lambda = next;
  }
  return Vec2::Zero();
}

bool climb(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2, const Vec2& d,
           Vec2& n, GapAlongAxis& here) {
  // A gain below the rounding of g = n·d − h₁ − h₂ cannot be seen.
  constexpr double unseen = 1e-17;
  if (!(here.curvature > 0) || here.gain() < unseen * n.dot(d)) return false;
  double turn = here.slope / here.curvature;
  for (int halving = 0; halving < 30; ++halving, turn *= 0.25) {
    const Vec2 trial = (n + turn * perpendicular(n)).normalized();
    const GapAlongAxis there = gap_along(one, u1, two, u2, d, trial);
    if (there.gap > here.gap) {
      n = trial;
      here = there;
      return true;
    }
  }
  return false;
}

void settle(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2, const Vec2& d,
            Vec2& n, GapAlongAxis& here) {
  constexpr int steps = 3;
  for (int step = 0; step < steps && here.curvature > 0; ++step) {
    n = (n + here.slope / here.curvature * perpendicular(n)).normalized();
    here = gap_along(one, u1, two, u2, d, n);
  }
}

}  // namespace detail

SupportGap support_gap(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
                       const Vec2& d) {
  Vec2 n = detail::find_separating_axis(one, u1, two, u2, d);
  if (n.isZero()) {
    // Overlapping: any axis shows the sign; the line of centres is as good as another.
    n = d.isZero() ? Vec2(1, 0) : Vec2(d.normalized());
    return {std::min(0.0, detail::gap_along(one, u1, two, u2, d, n).gap), n};
  }
  detail::GapAlongAxis here = detail::gap_along(one, u1, two, u2, d, n);
  for (int step = 0; step < max_newton_steps; ++step)
    if (!detail::climb(one, u1, two, u2, d, n, here)) break;
  detail::settle(one, u1, two, u2, d, n, here);
  return {here.gap, n};
}

SupportGap support_gap(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                       const Vec2& d) {
  return support_gap(one, direction(angle1), two, direction(angle2), d);
}

bool separated(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
               const Vec2& d, double margin) {
  const double distance_squared = d.squaredNorm();
  const double outer = one.a + two.a + margin;
  if (distance_squared >= outer * outer) return true;
  const double inner = one.b + two.b + margin;
  if (distance_squared < inner * inner) return false;

  Vec2 n = detail::find_separating_axis(one, u1, two, u2, d);
  if (n.isZero()) return false;
  detail::GapAlongAxis here = detail::gap_along(one, u1, two, u2, d, n);
  for (int step = 0; here.gap < margin && step < max_newton_steps; ++step)
    if (!detail::climb(one, u1, two, u2, d, n, here)) break;
  return here.gap >= margin;
}

}  // namespace vitrel
