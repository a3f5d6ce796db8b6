#include "analysis/structure/two_point.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "analysis/structure/fourier_arrays.h"

namespace vitrel {
namespace {

constexpr double max_points = 1 << 18;
constexpr double points_per_inradius = 8;

double target_spacing(const Configuration3& c) {
  double spacing = std::cbrt(c.box.volume() / max_points);
  if (c.size() == 0) return spacing;
  double inradius = c.shape.front().inradius();
  for (const ParticleShape<3>& shape : c.shape) inradius = std::min(inradius, shape.inradius());
  return std::max(spacing, inradius / points_per_inradius);
}

int wrapped(int node, int count) {
  const int rest = node % count;
  return rest < 0 ? rest + count : rest;
}

double overlap_of_unit_spheres(double distance) {
  return distance < 2 ? 1 + distance * (distance * distance / 16 - 0.75) : 0;
}

void add_lineal_path(std::vector<double>& path, const std::vector<double>& distance, double weight,
                     double per_length) {
  for (std::size_t k = 0; k < distance.size(); ++k)
    path[k] += weight * overlap_of_unit_spheres(distance[k] * per_length);
}

}  // namespace

struct TwoPointGrid::Transforms {
  explicit Transforms(const std::array<int, 3>& n)
      : points(static_cast<std::size_t>(n[0]) * n[1] * n[2]),
        modes(static_cast<std::size_t>(n[0]) * n[1] * (n[2] / 2 + 1)) {
    const auto in = real_array(points);
    const auto out = complex_array(modes);
    forward.emplace(modes, [&] {
      return fftw_plan_dft_r2c_3d(n[0], n[1], n[2], in.get(), out.get(), FFTW_ESTIMATE);
    });
    backward.emplace(modes, [&] {
      return fftw_plan_dft_c2r_3d(n[0], n[1], n[2], out.get(), in.get(), FFTW_ESTIMATE);
    });
  }

  /// Counts for every shift of the grid how many of its points coincide with points of itself, and multiplies this by
  /// their number.
  void correlate(double* grid) const {
    const auto out = complex_array(modes);
    fftw_execute_dft_r2c(forward->get(), grid, out.get());
    for (std::size_t k = 0; k < modes; ++k) {
      fftw_complex& mode = out[k];
      mode[0] = mode[0] * mode[0] + mode[1] * mode[1];
      mode[1] = 0;
    }
    fftw_execute_dft_c2r(backward->get(), out.get(), grid);
  }

  std::size_t points, modes;
  std::optional<FourierPlan> forward, backward;
};

/// The shell of every shift of the grid, and the mean distance and number of the shifts of a shell. A shift by n − k
/// nodes is one by k in the opposite direction, so an eighth of the shifts determines the shells of all.
struct TwoPointGrid::Shells {
  static constexpr std::uint16_t beyond = 0xffff;

  Shells(const Vec3& lengths, const Vec3& spacing, const std::array<int, 3>& n) : count(n) {
    const double width = spacing.maxCoeff(), range = 0.5 * lengths.minCoeff();
    const auto ways = [&](int k, int axis) { return k == 0 || 2 * k == n[axis] ? 1 : 2; };
    for (int x = 0; x <= n[0] / 2; ++x)
      for (int y = 0; y <= n[1] / 2; ++y)
        for (int z = 0; z <= n[2] / 2; ++z)
          add(spacing.cwiseProduct(Vec3(x, y, z)).norm(), ways(x, 0) * ways(y, 1) * ways(z, 2),
              width, range);
    for (std::size_t k = 0; k < distance.size(); ++k) distance[k] /= shifts[k];
  }

  void add(double r, int number, double width, double range) {
    const auto shell = static_cast<std::size_t>(std::lround(r / width));
    of_shift.push_back(r > range ? beyond : static_cast<std::uint16_t>(shell));
    if (r > range) return;
    if (shell >= distance.size()) distance.resize(shell + 1), shifts.resize(shell + 1);
    distance[shell] += number * r;
    shifts[shell] += number;
  }

  /// Calls visit(shell, number of the shift in the grid) for all shifts in range.
  void for_each_shift(const auto& visit) const {
    const auto nearest = [this](int k, int axis) { return std::min(k, count[axis] - k); };
    std::size_t shift = 0;
    for (int x = 0; x < count[0]; ++x)
      for (int y = 0; y < count[1]; ++y) {
        const std::size_t row = static_cast<std::size_t>(nearest(x, 0)) * (count[1] / 2 + 1) +
                                static_cast<std::size_t>(nearest(y, 1));
        const std::uint16_t* const of_row = &of_shift[row * (count[2] / 2 + 1)];
        for (int z = 0; z < count[2]; ++z, ++shift)
          if (const std::uint16_t shell = of_row[nearest(z, 2)]; shell != beyond)
            visit(shell, shift);
      }
  }

  std::array<int, 3> count;
  std::vector<std::uint16_t> of_shift;  // shells of shifts by up to half of the nodes
  std::vector<double> distance, shifts;
};

TwoPointGrid::TwoPointGrid(const Configuration3& first) : lengths_(first.box.lengths()) {
  const double target = target_spacing(first);
  for (int k = 0; k < 3; ++k) {
    count_[k] = fast_size(static_cast<int>(std::lround(lengths_[k] / target)));
    spacing_[k] = lengths_[k] / count_[k];
  }
  transforms_ = std::make_unique<Transforms>(count_);
  shells_ = std::make_unique<Shells>(lengths_, spacing_, count_);
}

TwoPointGrid::~TwoPointGrid() = default;
TwoPointGrid::TwoPointGrid(TwoPointGrid&&) noexcept = default;

TwoPointStatistics TwoPointGrid::measure(const Configuration3& configuration) const {
  TwoPointStatistics found;
  found.spacing = spacing_.maxCoeff();
  found.distance = shells_->distance;
  found.probability = probabilities(configuration);
  for (std::vector<double>& path : found.lineal_path) path.assign(found.distance.size(), 0.0);
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const ParticleShape<3>& shape = configuration.shape[i];
    const Mat3 inverse = shape_matrix(shape, configuration.orientation[i]).inverse();
    const double weight = shape.volume() / configuration.box.volume();
    for (int k = 0; k < 3; ++k)
      add_lineal_path(found.lineal_path[static_cast<std::size_t>(k)], found.distance, weight,
                      std::sqrt(inverse(k, k)));
  }
  return found;
}

std::vector<double> TwoPointGrid::probabilities(const Configuration3& configuration) const {
  const auto grid = real_array(transforms_->points);
  std::fill_n(grid.get(), transforms_->points, 0.0);
  for (std::size_t i = 0; i < configuration.size(); ++i)
    mark(grid.get(), shape_matrix(configuration.shape[i], configuration.orientation[i]),
         configuration.position[i]);
  transforms_->correlate(grid.get());
  std::vector<double> sum(shells_->distance.size(), 0.0);
  shells_->for_each_shift([&](std::size_t shell, std::size_t k) { sum[shell] += grid[k]; });
  const auto points = static_cast<double>(transforms_->points);
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= shells_->shifts[k] * points * points;
  return sum;
}

int TwoPointGrid::node_below(double coordinate, int axis) const {
  return static_cast<int>(std::floor(coordinate / spacing_[axis]));
}

/// Sets the points in a particle to one, row by row along z: there the particle is the interval between the roots of
/// a quadratic equation.
void TwoPointGrid::mark(double* grid, const Mat3& shape_matrix, const Vec3& position) const {
  const Mat3 m = shape_matrix.inverse();
  const double reach_x = std::sqrt(shape_matrix(0, 0)), reach_y = std::sqrt(shape_matrix(1, 1));
  for (int x = node_below(position.x() - reach_x, 0) + 1;
       x <= node_below(position.x() + reach_x, 0); ++x)
    for (int y = node_below(position.y() - reach_y, 1) + 1;
         y <= node_below(position.y() + reach_y, 1); ++y) {
      const double dx = x * spacing_.x() - position.x(), dy = y * spacing_.y() - position.y();
      const double slope = m(0, 2) * dx + m(1, 2) * dy;
      const double rest = 1 - m(0, 0) * dx * dx - 2 * m(0, 1) * dx * dy - m(1, 1) * dy * dy;
      const double discriminant = slope * slope + m(2, 2) * rest;
      if (discriminant < 0) continue;
      const double middle = position.z() - slope / m(2, 2);
      const double half = std::sqrt(discriminant) / m(2, 2);
      double* row = grid + (static_cast<std::size_t>(wrapped(x, count_[0])) * count_[1] +
                            wrapped(y, count_[1])) *
                               count_[2];
      for (int z = node_below(middle - half, 2) + 1; z <= node_below(middle + half, 2); ++z)
        row[wrapped(z, count_[2])] = 1;
    }
}

}  // namespace vitrel
