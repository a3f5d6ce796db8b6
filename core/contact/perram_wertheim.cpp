#include "core/contact/perram_wertheim.h"

#include <cmath>
#include <limits>

namespace vitrel {
namespace {

/// F as the rational function of t = λ/(1−λ) given in the header.
struct ContactFunction {
  double p1, p2;  ///< pᵢ = dᵀ adj(Σᵢ) d
  double d1, d2;  ///< Dᵢ = det Σᵢ
  double m;       ///< tr(Σ₁ adj Σ₂)

  double determinant(double t) const { return d1 + t * (m + t * d2); }

  double value(double t) const { return t * (p1 + p2 * t) / ((1 + t) * determinant(t)); }

  /// d ln F/d ln t.
  double slope(double t) const {
    return 1 + p2 * t / (p1 + p2 * t) - t / (1 + t) - t * (m + 2 * d2 * t) / determinant(t);
  }

  /// d² ln F/d(ln t)².
  double curvature(double t) const {
    const double p = p1 + p2 * t;
    const double det = determinant(t);
    return t * (p1 * p2 / (p * p) - 1 / ((1 + t) * (1 + t)) -
                (m * d1 + t * (4 * d1 * d2 + t * m * d2)) / (det * det));
  }
};

/// An ellipse and the directions of its axes.
struct Axes {
  Axes(const Ellipse& ellipse, double angle)
      : aa(ellipse.a * ellipse.a),
        bb(ellipse.b * ellipse.b),
        major(std::cos(angle), std::sin(angle)),
        minor(perpendicular(major)) {}

  double determinant() const { return aa * bb; }
  Vec2 shape_times(const Vec2& x) const {
    return (aa * major.dot(x)) * major + (bb * minor.dot(x)) * minor;
  }
  Vec2 adjugate_times(const Vec2& x) const {
    return (bb * major.dot(x)) * major + (aa * minor.dot(x)) * minor;
  }
  double adjugate_form(const Vec2& x) const {
    const double along = major.dot(x);
    const double across = minor.dot(x);
    return bb * along * along + aa * across * across;
  }

  double aa, bb;
  Vec2 major, minor;
};

double mixed_determinant(const Axes& one, const Axes& two) {
  const double c = one.major.dot(two.major);
  const double s = one.minor.dot(two.major);
  return c * c * (one.aa * two.bb + one.bb * two.aa) + s * s * (one.aa * two.aa + one.bb * two.bb);
}

/// The root of the slope in [low, high], where it falls from positive to negative.
double maximiser(const ContactFunction& f, double low, double high) {
  // The slope is a sum of four terms of order 1: below this it is rounding.
  constexpr double negligible = 4 * std::numeric_limits<double>::epsilon();
  constexpr int most_steps = 60;  // as many bisections exhaust a double
  double t = std::sqrt(low * high);
  for (int step = 0; step < most_steps; ++step) {
    const double slope = f.slope(t);
    if (std::abs(slope) <= negligible) break;
    (slope > 0 ? low : high) = t;
    const double curvature = f.curvature(t);
    double next = curvature < 0 ? t * std::exp(-slope / curvature) : low;
    if (!(next > low && next < high)) next = std::sqrt(low * high);
    if (next == t) break;
    t = next;
  }
  return t;
}

}  // namespace

PerramWertheim perram_wertheim(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                               const Vec2& d) {
  const Axes first(one, angle1);
  const Axes second(two, angle2);
  // A tiny d is scaled up, lest its square underflow.
  const double distance = d.norm();
  if (distance == 0) return {0, 0.5, Vec2::UnitX(), Vec2::Zero()};
  const Vec2 e = d / distance;

  const ContactFunction f{first.adjugate_form(e), second.adjugate_form(e), first.determinant(),
                          second.determinant(), mixed_determinant(first, second)};
  const double t = maximiser(f, one.b / two.a, one.a / two.b);
  const Vec2 normal = (first.adjugate_times(e) + t * second.adjugate_times(e)).normalized();
  // The surface of ellipse 1 has normal n at Σ₁n/h₁(n); scaled by μ it is the common point.
  const Vec2 sigma_n = first.shape_times(normal);
  const double mu = distance * std::sqrt(f.value(t));
  return {mu * mu, t / (1 + t), normal, (mu / std::sqrt(normal.dot(sigma_n))) * sigma_n};
}

double contact_distance(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                        const Vec2& direction) {
  const Vec2 e = direction.normalized();
  return 1 / std::sqrt(perram_wertheim(one, angle1, two, angle2, e).value);
}

}  // namespace vitrel
