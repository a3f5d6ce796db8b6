#include "core/contact/ellipsoid_gap.h"

#include <cmath>

namespace vitrel {

namespace {

constexpr int max_lambda_steps = 200;

Axis3 axis_along(const Vec3& w) {
  return completed(components(normalized(w)));
}

/// The Perram–Wertheim function of a pair.
class PerramWertheimAxis {
 public:
  explicit PerramWertheimAxis(const EllipsoidPair& pair)
      : d_(pair.d.isZero(0) ? Vec3(1, 0, 0) : pair.d),
        one_(matrix(pair, 0)),
        two_(matrix(pair, 1)) {}

  /// Returns the λ for which λ : 1 − λ is the ratio of the radii along d, where 1/rᵢ² = dᵀΣᵢ⁻¹d/d².
  double circle_like() const {
    const double r1 = 1 / std::sqrt(inverse_form(one_)), r2 = 1 / std::sqrt(inverse_form(two_));
    return std::isfinite(r1 + r2) && r1 + r2 > 0 ? r1 / (r1 + r2) : 0.5;
  }

  /// Returns C⁻¹d up to a factor.
  Vec3 direction(double lambda) const {
    const Vec3 w = adjugate(Mat3((1 - lambda) * one_ + lambda * two_)) * d_;
    return w.isZero(0) || !w.allFinite() ? d_ : w;
  }

  /// h₁(w)/h₂(w).
  double heights_ratio(const Vec3& w) const {
    return std::sqrt(dot(w, one_ * w) / dot(w, two_ * w));
  }

 private:
  static Mat3 matrix(const EllipsoidPair& pair, int lane) {
    Mat3 g;
    const auto row = [&](const Vec3Of<SimdPair>& v) -> Eigen::RowVector3d {
      return pair.size[lane] * Vec3(v.x[lane], v.y[lane], v.z[lane]).transpose();
    };
    g << row(pair.axes.first), row(pair.axes.second), row(pair.axes.third);
    return g.transpose() * g;
  }
  double inverse_form(const Mat3& sigma) const {
    return dot(d_, adjugate(sigma) * d_) / determinant(sigma);
  }

  Vec3 d_;
  Mat3 one_, two_;
};

EllipsoidPair pair_at_rest(const Ellipsoid& one, const Quaternion& orientation1,
                           const Ellipsoid& two, const Quaternion& orientation2, const Vec3& d) {
  const Mat3 turn1 = rotation_matrix(orientation1), turn2 = rotation_matrix(orientation2);
  const auto axis = [&](int k) -> Vec3Of<SimdPair> {
    const Vec3 u = one.semi_axes[k] * turn1.col(k), v = two.semi_axes[k] * turn2.col(k);
    return {{u.x(), v.x()}, {u.y(), v.y()}, {u.z(), v.z()}};
  };
  return {{axis(0), axis(1), axis(2)}, {1, 1}, d};
}

}  // namespace

namespace detail {

Axis3 initial_axis(const EllipsoidPair& pair) {
  const PerramWertheimAxis f(pair);
  return axis_along(f.direction(f.circle_like()));
}

SeparatingAxis<Axis3> find_separating_axis(const EllipsoidPair& pair) {
  const PerramWertheimAxis f(pair);
  double lambda = f.circle_like();
  double low = 0, high = 1;
  Vec3 w;
  for (int step = 0; step < max_lambda_steps; ++step) {
    w = f.direction(lambda);
    const Axis3 n = axis_along(w);
    if (gap_along(pair, n).gap > 0) return {n, true};
    const double ratio = f.heights_ratio(w);
    double next = ratio / (1 + ratio);  // the fixed point is the maximum
    (next > lambda ? low : high) = lambda;
    // The interval is bisected every fourth step, in case the iteration converges slowly.
    if (!(next > low && next < high) || step % 4 == 3) next = 0.5 * (low + high);
    if (std::abs(next - lambda) <= 1e-15 * lambda) break;
    lambda = next;
  }
  return {axis_along(w), false};
}

template bool improve_axis(const EllipsoidPair&, Axis3&, GapAlongAxis3&);

}  // namespace detail

SupportGap3 support_gap(const Ellipsoid& one, const Quaternion& orientation1, const Ellipsoid& two,
                        const Quaternion& orientation2, const Vec3& d) {
  return detail::largest_gap(pair_at_rest(one, orientation1, two, orientation2, d));
}

bool separated(const Ellipsoid& one, const Quaternion& orientation1, const Ellipsoid& two,
               const Quaternion& orientation2, const Vec3& d, double margin) {
  return detail::are_separated(
      one, two, d, margin, [&] { return pair_at_rest(one, orientation1, two, orientation2, d); });
}

Vec3 surface_point(const Ellipsoid& body, const Quaternion& orientation, const Vec3& n) {
  const Vec3 scaled = body.semi_axes.cwiseProduct(orientation.conjugate() * n);
  return orientation * body.semi_axes.cwiseProduct(scaled / norm(scaled));
}

}  // namespace vitrel
