#include "core/contact/ellipsoid_eta.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/extended.h"

namespace vitrel {
namespace {

using std::abs, std::sqrt;  // in addition to those of DoubleDouble

template <class Real>
using Vector = Eigen::Matrix<Real, 3, 1>;
template <class Real>
using Matrix = Eigen::Matrix<Real, 3, 3>;

/// d ln p/d ln τ and its derivative for p(τ) = Σ a_k τᵏ, where no a_k is negative. They are the mean and the variance
/// of k with the weights a_k τᵏ.
template <class Real>
struct LogDerivatives {
  Real mean = 0, variance = 0;

  LogDerivatives(const Real (&a)[5], Real tau) {
    Real sum = 0, power = 1, weight[5];
    for (int k = 0; k < 5; ++k, power *= tau) {
      weight[k] = a[k] * power;
      sum += weight[k];
      mean += k * weight[k];
    }
    mean /= sum;
    for (int k = 0; k < 5; ++k) variance += (k - mean) * (k - mean) * weight[k];
    variance /= sum;
  }
};

template <class Real>
Real aspect_ratio(const EllipsoidAxes<Real>& body) {
  return body.lengths.maxCoeff() / body.lengths.minCoeff();
}

/// p̄₁, p̄₂ and p̄₃, or the values that they would have if all terms of their sums were positive.
template <class Real>
struct Coefficients {
  Real p1, p2, p3;

  Real beta1() const { return 1 - 4 * p1 * p3 + 3 * p2 * p2; }
  Real beta2() const { return p2 * (1 - p2 * p2 + 2 * p1 * p3) - p1 * p1 - p3 * p3; }
  Real sum1() const { return 1 + 4 * p1 * p3 + 3 * p2 * p2; }
  Real sum2() const { return p2 * (1 + p2 * p2 + 2 * p1 * p3) + p1 * p1 + p3 * p3; }
};

/// Returns a bound of the error of η₁ if all e and u are known to `accuracy`, relative to their sums. The error of β₁
/// is then at most 2 `accuracy` times the sum of the magnitudes of its terms, and that of β₂ 3 `accuracy` times that
/// sum.
template <class Real>
Real error_of_eta1(const Coefficients<Real>& p, const Coefficients<Real>& sums, Real accuracy) {
  const Real blur1 = 2 * accuracy * sums.sum1();
  const Real blur2 = 3 * accuracy * sums.sum2();
  const Real beta1 = abs(p.beta1()) + blur1;
  const Real beta2 = abs(p.beta2()) + blur2;
  return 3 * beta1 * beta1 * blur1 + 54 * beta2 * blur2;
}

}  // namespace

template <class Real>
Real CharacteristicPolynomial<Real>::operator()(Real tau) const {
  Real value = 1;
  for (int k = 3; k >= 0; --k) value = value * tau + coefficient(k);
  return value;
}

template <class Real>
Real CharacteristicPolynomial<Real>::maximizer() const {
  // F is flat at its maximum, so half the digits of τ give all digits of F.
  const Real tolerance = sqrt(std::numeric_limits<Real>::epsilon()) / 64;
  constexpr int max_steps = 80;
  Real low = min_ratio, high = max_ratio;
  Real tau = sqrt(low * high);
  for (int step = 0; step < max_steps; ++step) {
    const LogDerivatives<Real> up(negative, tau), down(positive, tau);
    const Real slope = up.mean - down.mean;
    if (slope == 0) break;
    (slope > 0 ? low : high) = tau;
    const Real curvature = up.variance - down.variance;
    Real next = low;
    if (curvature < 0)
      next = tau + tau * exponential_minus_one(static_cast<double>(-slope / curvature));
    if (!(next > low && next < high)) next = sqrt(low * high);
    const bool converged = abs(next - tau) <= tolerance * tau;
    tau = next;
    if (converged) break;
  }
  return tau;
}

template <class Real>
CharacteristicPolynomial<Real> characteristic_polynomial(const EllipsoidAxes<Real>& one,
                                                         const EllipsoidAxes<Real>& two,
                                                         const Vector<Real>& d) {
  const Vector<Real> r = one.directions.transpose() * d;
  const Matrix<Real> cosines = one.directions.transpose() * two.directions;
  const Matrix<Real> ratio = one.lengths * two.lengths.cwiseInverse().transpose();
  const Matrix<Real> squares = cosines.cwiseAbs2();
  const Real trace1 = squares.cwiseProduct(ratio.cwiseAbs2()).sum();
  const Real trace2 = squares.cwiseQuotient(ratio.cwiseAbs2()).sum();
  const Real volume = one.lengths.prod();
  const Real sigma2 = volume / two.lengths.prod();
  const Real sigma = sqrt(sigma2);

  const Real quadric1 = r.cwiseQuotient(one.lengths).squaredNorm();
  const Real quadric2 = (two.directions.transpose() * d).cwiseQuotient(two.lengths).squaredNorm();
  Real mixed = 0;
  for (int l = 0; l < 3; ++l) {
    const Vector<Real> axis = cosines.col(l);
    mixed += (two.lengths[l] / volume * axis.cross(r).cwiseProduct(one.lengths)).squaredNorm();
  }

  return {sigma,
          {1, sigma * (1 + trace2), trace1 / sigma2 + sigma2 * trace2, (1 + trace1) / sigma, 1},
          {0, sigma * quadric1, sigma2 * mixed, quadric2 / sigma, 0},
          one.lengths.minCoeff() / two.lengths.maxCoeff() / sigma,
          one.lengths.maxCoeff() / two.lengths.minCoeff() / sigma};
}

template <class Real>
EllipsoidEta<Real> ellipsoid_eta(const EllipsoidAxes<Real>& one, const EllipsoidAxes<Real>& two,
                                 const Vector<Real>& d) {
  const CharacteristicPolynomial<Real> q = characteristic_polynomial(one, two, d);
  const Coefficients<Real> p{-q.coefficient(3) / 4, q.coefficient(2) / 6, -q.coefficient(1) / 4};
  const Coefficients<Real> sums{(q.positive[3] + q.negative[3]) / 4,
                                (q.positive[2] + q.negative[2]) / 6,
                                (q.positive[1] + q.negative[1]) / 4};
  const Real beta1 = p.beta1();
  const Real beta2 = p.beta2();
  const Real delta1 = p.p3 - p.p1 * p.p2;
  const Real delta2 = 1 - p.p1 * p.p3;
  const Real delta3 = p.p2 * p.p2 - p.p1 * p.p3;

  EllipsoidEta<Real> eta;
  eta.p1 = p.p1, eta.p2 = p.p2, eta.p3 = p.p3;
  eta.eta5 = p.p1 * p.p1 - p.p2;
  eta.eta4 = -delta2;
  eta.eta3 = beta1 * delta1 - 3 * p.p1 * beta2;
  eta.eta2 = -9 * delta1 * delta1 + eta.eta5 * (27 * delta3 - 3 * delta2);
  eta.eta1 = beta1 * beta1 * beta1 - 27 * beta2 * beta2;
  // Directions are accurate to a few ε, so the long semi-axis of one body is off by a few ε times its aspect ratio in
  // units of the short one.
  const Real accuracy =
      16 * std::numeric_limits<Real>::epsilon() * std::max(aspect_ratio(one), aspect_ratio(two));
  eta.rounding = error_of_eta1(p, sums, accuracy);
  eta.min_value = eta.decides() || d.isZero(0) ? 1 : q(q.maximizer());
  return eta;
}

template <class Real>
EllipsoidTouch<Real> ellipsoid_touch(const EllipsoidAxes<Real>& one, const EllipsoidAxes<Real>& two,
                                     const Vector<Real>& d) {
  const CharacteristicPolynomial<Real> q = characteristic_polynomial(one, two, d);
  const auto shape_matrix = [](const EllipsoidAxes<Real>& body) -> Matrix<Real> {
    const Matrix<Real> axes = body.directions * body.lengths.asDiagonal();
    return axes * axes.transpose();
  };
  const Matrix<Real> sigma1 = shape_matrix(one);
  const Matrix<Real> both = sigma1 + q.sigma * q.maximizer() * shape_matrix(two);
  const Vector<Real> y = both.llt().solve(d);
  return {sigma1 * y, y.normalized()};
}

EllipsoidEta<double> ellipsoid_eta(const Ellipsoid& one, const Quaternion& orientation1,
                                   const Ellipsoid& two, const Quaternion& orientation2,
                                   const Vec3& d) {
  return ellipsoid_eta<double>({one, orientation1}, {two, orientation2}, d);
}

#define VITREL_INSTANTIATE(Real)                                                              \
  template struct CharacteristicPolynomial<Real>;                                             \
  template EllipsoidEta<Real> ellipsoid_eta(const EllipsoidAxes<Real>&,                       \
                                            const EllipsoidAxes<Real>&, const Vector<Real>&); \
  template CharacteristicPolynomial<Real> characteristic_polynomial(                          \
      const EllipsoidAxes<Real>&, const EllipsoidAxes<Real>&, const Vector<Real>&);           \
  template EllipsoidTouch<Real> ellipsoid_touch(const EllipsoidAxes<Real>&,                   \
                                                const EllipsoidAxes<Real>&, const Vector<Real>&);
VITREL_INSTANTIATE(double)
VITREL_INSTANTIATE(long double)
VITREL_INSTANTIATE(DoubleDouble)

}  // namespace vitrel
