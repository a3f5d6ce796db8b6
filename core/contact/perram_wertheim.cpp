#include "core/contact/perram_wertheim.h"

#include <cmath>
#include <limits>

#include "core/elementary.h"

namespace vitrel {
namespace {

/// Derivatives of ln F with respect to ln t.
struct Derivatives {
  double slope, curvature;
};

/// F as a function of t = λ/(1−λ), in the rational form of the header.
struct ContactFunction {
  double p1, p2;  ///< pᵢ = dᵀ adj(Σᵢ) d
  double d1, d2;  ///< Dᵢ = det Σᵢ
  double m;       ///< tr(Σ₁ adj Σ₂)

  double determinant(double t) const { return d1 + t * (m + t * d2); }

  double value(double t) const { return t * (p1 + p2 * t) / ((1 + t) * determinant(t)); }

  Derivatives derivatives(double t) const {
    const double p = p1 + p2 * t;
    const double det = determinant(t);
    return {1 + p2 * t / p - t / (1 + t) - t * (m + 2 * d2 * t) / det,
            t * (p1 * p2 / (p * p) - 1 / ((1 + t) * (1 + t)) -
                 (m * d1 + t * (4 * d1 * d2 + t * m * d2)) / (det * det))};
  }
};

/// An ellipse and the directions of its axes.
struct Axes {
  Axes(const Ellipse& ellipse, double angle)
      : aa(ellipse.a * ellipse.a),
        bb(ellipse.b * ellipse.b),
        major(direction(angle)),
        minor(perpendicular(major)) {}

  double determinant() const { return aa * bb; }
  Vec2 shape_times(const Vec2& x) const {
    return (aa * dot(major, x)) * major + (bb * dot(minor, x)) * minor;
  }
  Vec2 adjugate_times(const Vec2& x) const {
    return (bb * dot(major, x)) * major + (aa * dot(minor, x)) * minor;
  }
  double adjugate_form(const Vec2& x) const {
    const double along = dot(major, x);
    const double across = dot(minor, x);
    return bb * along * along + aa * across * across;
  }

  double aa, bb;
  Vec2 major, minor;
};

double mixed_determinant(const Axes& one, const Axes& two) {
  const double c = dot(one.major, two.major);
  const double s = dot(one.minor, two.major);
  return c * c * (one.aa * two.bb + one.bb * two.aa) + s * s * (one.aa * two.aa + one.bb * two.bb);
}

/// Solves A x = b for a positive definite A = L Lᵀ.
class Cholesky {
 public:
  explicit Cholesky(const Mat3& a) {
    for (int j = 0; j < 3; ++j)
      for (int i = j; i < 3; ++i) {
        double rest = a(i, j);
        for (int k = 0; k < j; ++k) rest -= l_(i, k) * l_(j, k);
        l_(i, j) = i == j ? std::sqrt(rest) : rest / l_(j, j);
      }
  }

  Vec3 solve(Vec3 x) const {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < i; ++k) x[i] -= l_(i, k) * x[k];
      x[i] /= l_(i, i);
    }
    for (int i = 2; i >= 0; --i) {
      for (int k = i + 1; k < 3; ++k) x[i] -= l_(k, i) * x[k];
      x[i] /= l_(i, i);
    }
    return x;
  }

 private:
  Mat3 l_;  ///< only the lower triangle is used
};

/// Two ellipsoids, given by the matrices of their semi-axes (as columns), and d.
struct EllipsoidPair {
  Mat3 axes1, axes2;
  Vec3 d;
  Mat3 sigma1 = axes1 * axes1.transpose(), sigma2 = axes2 * axes2.transpose();

  /// Returns y = (Σ₁ + tΣ₂)⁻¹d, which is along the common normal at the maximum of F.
  Vec3 direction(double t) const { return Cholesky(sigma1 + t * sigma2).solve(d); }

  double height1(const Vec3& n) const { return norm(axes1.transpose() * n); }
  double height2(const Vec3& n) const { return norm(axes2.transpose() * n); }

  Derivatives derivatives(double t) const {
    const Cholesky both(sigma1 + t * sigma2);
    const Vec3 y = both.solve(d);
    const Vec3 z = sigma2 * y;
    const double hh1 = squared_norm(axes1.transpose() * y);
    const double hh2 = dot(y, z);
    const double along = hh1 + t * hh2;
    const double weight = t * hh2 / along;
    return {(hh1 - t * t * hh2) / ((1 + t) * along), 2 * t * t * dot(z, both.solve(z)) / along -
                                                         weight - weight * weight -
                                                         t / ((1 + t) * (1 + t))};
  }
};

Mat3 semi_axes(const Ellipsoid& ellipsoid, const Quaternion& orientation) {
  return rotation_matrix(orientation) * ellipsoid.semi_axes.asDiagonal();
}

/// Returns the root of the slope in [low, high], where the slope falls from positive to negative.
double maximizer(const auto& f, double low, double high) {
  // The slope is a sum of four terms of order 1, so smaller values are rounding.
  constexpr double negligible = 4 * std::numeric_limits<double>::epsilon();
  constexpr int max_steps = 60;  // enough for bisection alone
  double t = std::sqrt(low * high);
  for (int step = 0; step < max_steps; ++step) {
    const auto [slope, curvature] = f.derivatives(t);
    if (std::abs(slope) <= negligible) break;
    (slope > 0 ? low : high) = t;
    double next = curvature < 0 ? t * exponential(-slope / curvature) : low;
    if (!(next > low && next < high)) next = std::sqrt(low * high);
    if (next == t) break;
    t = next;
  }
  return t;
}

}  // namespace

PerramWertheim<2> perram_wertheim(const Ellipse& one, double angle1, const Ellipse& two,
                                  double angle2, const Vec2& d) {
  const Axes first(one, angle1);
  const Axes second(two, angle2);
  // d is normalised so that the square of a tiny d does not underflow.
  const double distance = norm(d);
  if (distance == 0) return {0, 0.5, Vec2::UnitX(), Vec2::Zero()};
  const Vec2 e = d / distance;

  const ContactFunction f{first.adjugate_form(e), second.adjugate_form(e), first.determinant(),
                          second.determinant(), mixed_determinant(first, second)};
  const double t = maximizer(f, one.b / two.a, one.a / two.b);
  const Vec2 normal = normalized(first.adjugate_times(e) + t * second.adjugate_times(e));
  // The surface of ellipse 1 has the normal n at Σ₁n/h₁(n); this point scaled by μ is the common point.
  const Vec2 sigma_n = first.shape_times(normal);
  const double mu = distance * std::sqrt(f.value(t));
  return {mu * mu, t / (1 + t), normal, (mu / std::sqrt(dot(normal, sigma_n))) * sigma_n};
}

double contact_distance(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                        const Vec2& direction) {
  const Vec2 e = normalized(direction);
  return 1 / std::sqrt(perram_wertheim(one, angle1, two, angle2, e).value);
}

PerramWertheim<3> perram_wertheim(const Ellipsoid& one, const Quaternion& orientation1,
                                  const Ellipsoid& two, const Quaternion& orientation2,
                                  const Vec3& d) {
  const double distance = norm(d);
  if (distance == 0) return {0, 0.5, Vec3::UnitX(), Vec3::Zero()};
  const EllipsoidPair pair{semi_axes(one, orientation1), semi_axes(two, orientation2),
                           d / distance};
  const double t =
      maximizer(pair, one.inradius() / two.circumradius(), one.circumradius() / two.inradius());
  const Vec3 n = normalized(pair.direction(t));
  const double h1 = pair.height1(n);
  const double mu = distance * dot(n, pair.d) / (h1 + pair.height2(n));
  return {mu * mu, t / (1 + t), n, (mu / h1) * (pair.sigma1 * n)};
}

double contact_distance(const Ellipsoid& one, const Quaternion& orientation1, const Ellipsoid& two,
                        const Quaternion& orientation2, const Vec3& direction) {
  const Vec3 e = normalized(direction);
  return 1 / std::sqrt(perram_wertheim(one, orientation1, two, orientation2, e).value);
}

}  // namespace vitrel
