#include "bench/reference/taylor_top.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrel::bench {

TaylorTop::TaylorTop(const Ellipsoid& shape, const Quaternion& orientation,
                     const Vec3& angular_velocity, Real end)
    : direction_(end < 0 ? -1 : 1) {
  const Vector squares = shape.semi_axes.cast<Real>().cwiseAbs2();
  const Vector moments = Vector::Constant(squares.sum()) - squares;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    factors_[i] = (squares[k] - squares[j]) / moments[i];
  }
  BodyState state{orientation.cast<Real>().normalized(), {}};
  state.omega = state.attitude.conjugate() * angular_velocity.cast<Real>();

  const Vector momenta = moments.cwiseProduct(state.omega);
  const Real twice_energy = momenta.dot(state.omega);
  const Real middle = moments.sum() - moments.minCoeff() - moments.maxCoeff();
  speed_bound_ = std::sqrt(twice_energy / moments.minCoeff());
  instability_ = std::sqrt(twice_energy / middle * (moments.maxCoeff() - middle) *
                           (middle - moments.minCoeff()) / moments.minCoeff() / moments.maxCoeff());
  distance_from_separatrix_ =
      std::abs(momenta.dot((moments.array() - middle).matrix().cwiseProduct(state.omega))) /
      std::max(momenta.squaredNorm(), twice_energy * middle);

  Real time = 0;
  do {
    series_.push_back(expanded(time, state));
    const Real next = time + direction_ * step(series_.back());
    state = evaluated(series_.back(), next);
    time = next;
  } while (std::abs(time) < std::abs(end));
}

TaylorTop::State TaylorTop::at(Real time) const {
  const auto past = std::ranges::upper_bound(series_, direction_ * time, {},
                                             [](const Series& one) { return std::abs(one.start); });
  const BodyState state = evaluated(past == series_.begin() ? *past : *std::prev(past), time);
  return {state.attitude.toRotationMatrix(), state.attitude * state.omega};
}

TaylorTop::Real TaylorTop::sensitivity(Real time) const {
  const Real growth =
      std::min(std::exp(instability_ * std::abs(time)), 1 / distance_from_separatrix_);
  return speed_bound_ * std::abs(time) * growth;
}

TaylorTop::Series TaylorTop::expanded(Real start, const BodyState& state) const {
  Series series;
  series.start = start;
  series.omega[0] = state.omega;
  series.attitude[0] = state.attitude;
  for (int n = 0; n < order; ++n) {
    Vector products = Vector::Zero();
    Eigen::Matrix<Real, 4, 1> turning = Eigen::Matrix<Real, 4, 1>::Zero();
    for (int k = 0; k <= n; ++k) {
      const Vector &one = series.omega[k], &two = series.omega[n - k];
      products += Vector(one[1] * two[2], one[2] * two[0], one[0] * two[1]);
      turning += (series.attitude[k] * Attitude(0, two[0], two[1], two[2])).coeffs();
    }
    series.omega[n + 1] = factors_.cwiseProduct(products) / (n + 1);
    series.attitude[n + 1].coeffs() = turning / (2 * (n + 1));
  }
  return series;
}

TaylorTop::Real TaylorTop::step(const Series& series) {
  constexpr Real last_term = std::numeric_limits<Real>::epsilon() / 16;
  constexpr Real at_rest = std::numeric_limits<Real>::min();
  const Real speed = std::max(series.omega[0].norm(), at_rest);
  Real longest = std::numeric_limits<double>::max();  // the value for a body at rest
  for (const int n : {order - 1, order}) {
    const Real size = std::max(series.omega[n].norm() / speed, series.attitude[n].norm());
    if (size > 0) longest = std::min(longest, std::pow(last_term / size, Real(1) / n));
  }
  return longest;
}

TaylorTop::BodyState TaylorTop::evaluated(const Series& series, Real time) {
  const Real t = time - series.start;
  Vector omega = series.omega[order];
  Eigen::Matrix<Real, 4, 1> attitude = series.attitude[order].coeffs();
  for (int n = order - 1; n >= 0; --n) {
    omega = omega * t + series.omega[n];
    attitude = attitude * t + series.attitude[n].coeffs();
  }
  return {Attitude(attitude).normalized(), omega};
}

}  // namespace vitrel::bench
