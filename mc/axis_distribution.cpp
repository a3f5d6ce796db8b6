#include "mc/axis_distribution.h"

#include <algorithm>
#include <cmath>

#include "core/random/stream.h"

namespace vitrel {
namespace {

constexpr double smallest_moment = 1e-9;
constexpr double moment_precision = 1e-13;
constexpr int max_steps = 200;  // about 50 suffice

/// Returns Carlson's R_D(x, y, z) by duplication; the series is exact to ε⁶ < 1e-18 of the value.
double carlson_r_d(double x, double y, double z) {
  constexpr double epsilon = 1e-3;
  double sum = 0, factor = 1;
  while (true) {
    const double mean = (x + y + 3 * z) / 5;
    const double u = (mean - x) / mean, v = (mean - y) / mean, w = -(u + v) / 3;
    if (std::max({std::abs(u), std::abs(v), std::abs(w)}) < epsilon) {
      const double e2 = u * v - 6 * w * w, e3 = (3 * u * v - 8 * w * w) * w;
      const double e4 = 3 * (u * v - w * w) * w * w, e5 = u * v * w * w * w;
      const double series = 1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22 -
                            9 * e2 * e3 / 52 + 3 * e5 / 26;
      return 3 * sum + factor * series / (mean * std::sqrt(mean));
    }
    const double step =
        std::sqrt(x) * std::sqrt(y) + std::sqrt(y) * std::sqrt(z) + std::sqrt(z) * std::sqrt(x);
    sum += factor / (std::sqrt(z) * (z + step));
    factor /= 4;
    x = (x + step) / 4;
    y = (y + step) / 4;
    z = (z + step) / 4;
  }
}

/// Returns the standard deviations of x along the principal axes, up to a common factor.
Vec2 deviations(const Vec2& moments) {
  return moments;
}
Vec3 deviations(const Vec3& moments) {
  return angular_gaussian_variances(moments).cwiseSqrt();
}

/// Diagonalises a symmetric matrix by Jacobi rotations, so that it holds the eigenvalues; the columns of `vectors`
/// become its eigenvectors.
template <class Matrix>
void diagonalise(Matrix& matrix, Matrix& vectors) {
  constexpr int n = Matrix::RowsAtCompileTime, max_sweeps = 20;  // about 5 suffice
  vectors = Matrix::Identity();
  for (int sweep = 0; sweep < max_sweeps && !matrix.isDiagonal(0); ++sweep)
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j) {
        if (matrix(i, j) == 0) continue;
        const double slope = (matrix(j, j) - matrix(i, i)) / (2 * matrix(i, j));
        const double tangent =
            std::copysign(1, slope) / (std::abs(slope) + std::sqrt(1 + slope * slope));
        const double cosine = 1 / std::sqrt(1 + tangent * tangent);
        Matrix turn = Matrix::Identity();
        turn(i, i) = turn(j, j) = cosine;
        turn(i, j) = tangent * cosine;
        turn(j, i) = -tangent * cosine;
        matrix = turn.transpose() * matrix * turn;
        matrix(i, j) = matrix(j, i) = 0;
        vectors = vectors * turn;
      }
}

}  // namespace

Vec3 angular_gaussian_moments(const Vec3& variances) {
  const Vec3 mu = variances.cwiseInverse();
  Vec3 moments;
  for (int k = 0; k < 3; ++k) moments[k] = carlson_r_d(mu[(k + 1) % 3], mu[(k + 2) % 3], mu[k]);
  return std::sqrt(prod(mu)) / 3 * moments;
}

Vec3 angular_gaussian_variances(const Vec3& moments) {
  if (moments.minCoeff() < smallest_moment) return moments.cwiseAbs2();
  Vec3 variances = moments.cwiseAbs2();
  for (int step = 0; step < max_steps; ++step) {
    const Vec3 ratio = moments.cwiseQuotient(angular_gaussian_moments(variances));
    if ((ratio - Vec3::Ones()).cwiseAbs().maxCoeff() < moment_precision) break;
    variances = variances.cwiseProduct(ratio.cwiseProduct(ratio.cwiseSqrt()));
    variances /= variances.maxCoeff();
  }
  return variances;
}

template <int Dim>
AxisDistribution<Dim>::AxisDistribution(const Tensor& tensor) {
  Tensor principal = tensor, axes;
  diagonalise(principal, axes);
  Vec<Dim> moments = principal.diagonal().cwiseMax(0);
  moments /= sum(moments);
  map_ = axes * deviations(moments).asDiagonal();
}

template <int Dim>
Vec<Dim> AxisDistribution<Dim>::operator()(Stream& draw) const {
  Vec<Dim> normal;
  for (int k = 0; k < Dim; ++k) normal[k] = draw.normal();
  return normalized(map_ * normal);
}

template class AxisDistribution<2>;
template class AxisDistribution<3>;

}  // namespace vitrel
