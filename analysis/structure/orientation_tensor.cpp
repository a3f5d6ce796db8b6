#include "analysis/structure/orientation_tensor.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/random/stream.h"
#include "core/special_values.h"

namespace vitrel {

namespace {

constexpr std::size_t max_drawn = 1000, packings_drawn = 2000;
// The smallest numbers of axes for which ⟨ρ⟩ and ⟨ρ²⟩ are finite.
constexpr std::size_t min_for_mean = 5, min_for_deviation = 7;

/// Lifts a random point of the unit disk to the sphere (Marsaglia, 1972); each attempt takes one random word.
Vec3 isotropic_axis(Stream& draw) {
  while (true) {
    const std::uint64_t word = draw.bits();
    const double x = 0x1p-31 * static_cast<double>(static_cast<std::uint32_t>(word)) - 1,
                 y = 0x1p-31 * static_cast<double>(word >> 32) - 1, square = x * x + y * y;
    if (square >= 1) continue;
    const double scale = 2 * std::sqrt(1 - square);
    return {scale * x, scale * y, 1 - 2 * square};
  }
}

OrientationTensor isotropic_tensor(std::size_t axes, Stream& draw) {
  OrientationTensor tensor{Mat3::Zero(), axes};
  for (std::size_t i = 0; i < axes; ++i) {
    const Vec3 w = isotropic_axis(draw);
    tensor.matrix += w * w.transpose();
  }
  tensor.matrix /= static_cast<double>(axes);
  return tensor;
}

IsotropicRatio drawn_ratio(std::size_t axes) {
  double sum = 0, squares = 0;
  for (std::size_t packing = 0; packing < packings_drawn; ++packing) {
    Stream draw(0, Purpose::isotropic_axes, packing);
    const double ratio = isotropic_tensor(axes, draw).ratio();
    sum += ratio;
    squares += ratio * ratio;
  }
  const double mean = sum / packings_drawn;
  if (axes < min_for_deviation) return {mean, infinity};
  return {mean, std::sqrt(squares / packings_drawn - mean * mean)};
}

IsotropicRatio expanded_ratio(double axes) {
  using std::numbers::pi;
  const double s = std::sqrt(2 / (15 * axes));
  const double g = 3 * std::sqrt(3 / pi) * s, g_2 = 9.5 * s * s;
  const double g_3 = (27 * std::sqrt(3.0) + 4 * pi) / std::sqrt(pi) * s * s * s;
  const double variance = 9 * (g_2 - g * g) + 27 * (g_3 - g * g_2);
  return {1 + 3 * g + 4.5 * g_2, std::sqrt(variance)};
}

}  // namespace

Vec3 OrientationTensor::eigenvalues() const {
  return Eigen::SelfAdjointEigenSolver<Mat3>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

double OrientationTensor::ratio() const {
  if (axes == 0) return std::numeric_limits<double>::quiet_NaN();
  const Vec3 values = eigenvalues();
  // Below this, the smallest eigenvalue is rounding.
  return axes < 3 || values[0] <= 1e-15 ? infinity : values[2] / values[0];
}

double OrientationTensor::nematic_order() const {
  return axes == 0 ? 0 : 1.5 * eigenvalues()[2] - 0.5;
}

Vec3 OrientationTensor::director() const {
  return Eigen::SelfAdjointEigenSolver<Mat3>(matrix).eigenvectors().col(2);
}

OrientationTensor orientation_tensor(const Configuration3& packing) {
  OrientationTensor tensor;
  for (std::size_t i = 0; i < packing.size(); ++i) {
    if (packing.shape[i].is_round()) continue;
    const Vec3 w = figure_axis(packing.shape[i], packing.orientation[i]);
    tensor.matrix += w * w.transpose();
    ++tensor.axes;
  }
  if (tensor.axes > 0) tensor.matrix /= static_cast<double>(tensor.axes);
  return tensor;
}

IsotropicRatio isotropic_ratio(std::size_t axes) {
  if (axes < min_for_mean) return {infinity, infinity};
  return axes <= max_drawn ? drawn_ratio(axes) : expanded_ratio(static_cast<double>(axes));
}

}  // namespace vitrel
