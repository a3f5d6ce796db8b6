#include "analysis/density_grid.h"

#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vitrel {

namespace {

constexpr double pi = std::numbers::pi;

using SplineValues = std::array<double, spline_order>;

/// The B-spline at the nodes around a point that lies `fraction` beyond the middle left one, from
/// left to right; by the recursion over the order, upwards from 2.
SplineValues spline_values(double fraction) {
  SplineValues value{};
  value[0] = 1 - fraction;
  value[1] = fraction;
  for (int order = 3; order <= spline_order; ++order) {
    const double scale = 1.0 / (order - 1);
    value[order - 1] = scale * fraction * value[order - 2];
    for (int k = order - 2; k > 0; --k)
      value[k] =
          scale * ((fraction + (order - 1 - k)) * value[k - 1] + (k + 1 - fraction) * value[k]);
    value[0] *= scale * (1 - fraction);
  }
  return value;
}

double sum_of_images(double x) {
  double sum = 1;
  for (int m = 1;; ++m) {
    const double two = std::pow(std::abs(x) / (m - std::abs(x)), spline_order) +
                       std::pow(std::abs(x) / (m + std::abs(x)), spline_order);
    sum += two;
    if (two < 1e-20) return sum;
  }
}

/// (sin(π x)/(π x))^p.
double transformed_spline(double x) {
  return x == 0 ? 1 : std::pow(std::sin(pi * x) / (pi * x), spline_order);
}

int least_nodes(double length, double to) {
  const double least = length * to / (2 * pi * largest_grid_wave);
  return std::max(spline_order, static_cast<int>(std::ceil(least)));
}

/// The least even number from n on without prime factors above 7, for which transforms are fast.
int fast_size(int n) {
  for (n += n % 2;; n += 2) {
    int rest = n;
    for (const int prime : {2, 3, 5, 7})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return n;
  }
}

template <class T>
struct FreeArray {
  void operator()(T* array) const { fftw_free(array); }
};
template <class T>
using Array = std::unique_ptr<T[], FreeArray<T>>;

Array<double> real_array(std::size_t n) {
  return Array<double>(fftw_alloc_real(n));
}
Array<fftw_complex> complex_array(std::size_t n) {
  return Array<fftw_complex>(fftw_alloc_complex(n));
}

}  // namespace

double alias_bound(const Vec2& x) {
  return sum_of_images(x.x()) * sum_of_images(x.y()) - 1;
}

/// From a grid whose rows and columns go on beyond the period, to n_x × (n_y/2 + 1) modes.
struct DensityGrid::Transform {
  Transform(const int (&count)[2], std::size_t row)
      : reals((count[0] + spline_order) * row), complexes(count[0] * (count[1] / 2 + 1)) {
    const Array<double> in = real_array(reals);
    const Array<fftw_complex> out = complex_array(complexes);
    const int in_size[2] = {count[0] + spline_order, static_cast<int>(row)};
    plan = fftw_plan_many_dft_r2c(2, count, 1, in.get(), in_size, 1, 0, out.get(), nullptr, 1, 0,
                                  FFTW_ESTIMATE);
  }
  ~Transform() { fftw_destroy_plan(plan); }
  Transform(const Transform&) = delete;
  Transform& operator=(const Transform&) = delete;

  std::size_t reals, complexes;
  fftw_plan plan;
};

DensityGrid::DensityGrid(const Vec2& lengths, double from, double to) : lengths_(lengths) {
  for (int k = 0; k < 2; ++k) count_[k] = fast_size(least_nodes(lengths[k], to));
  row_ = static_cast<std::size_t>(count_[1] + spline_order);
  transform_ = std::make_unique<Transform>(count_, row_);
  list_wave_vectors(from, to);
}

DensityGrid::~DensityGrid() = default;
DensityGrid::DensityGrid(DensityGrid&&) noexcept = default;

double DensityGrid::nodes(const Vec2& lengths, double to) {
  return static_cast<double>(least_nodes(lengths.x(), to)) * least_nodes(lengths.y(), to);
}

void DensityGrid::list_wave_vectors(double from, double to) {
  const Vec2 unit = 2 * pi * lengths_.cwiseInverse();
  const int most_x = static_cast<int>(to / unit.x());
  const int most_y = static_cast<int>(to / unit.y());
  for (int x = -most_x; x <= most_x; ++x)
    for (int y = x > 0 ? 0 : 1; y <= most_y; ++y) {
      const double q = unit.cwiseProduct(Vec2(x, y)).norm();
      if (q >= to) break;
      if (q < from) continue;
      wave_vectors_.push_back({x, y, q});
      index_.push_back(static_cast<std::size_t>(x < 0 ? x + count_[0] : x) * (count_[1] / 2 + 1) +
                       y);
      const double sign = (x + y) % 2 == 0 ? 1 : -1;
      gain_.push_back(sign / (transformed_spline(static_cast<double>(x) / count_[0]) *
                              transformed_spline(static_cast<double>(y) / count_[1])));
    }
}

/// Where a point lies: the first of its p nodes in both directions, and how far beyond the middle left
/// one.
struct DensityGrid::Place {
  std::size_t point;
  std::size_t first[2];
  double fraction[2];
};

// Sorted by rows: points next to each other then write to the same part of the grid, which the cache
// keeps.
std::vector<DensityGrid::Place> DensityGrid::places(std::span<const Vec2> positions) const {
  std::vector<Place> places;
  std::vector<std::size_t> next(static_cast<std::size_t>(count_[0]) + 1, 0);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Place& place = places.emplace_back(Place{i, {}, {}});
    for (int k = 0; k < 2; ++k) {
      double box = positions[i][k] / lengths_[k] + 0.5;
      box -= std::floor(box);
      const double at = box * count_[k];
      const double node = std::floor(at);
      place.first[k] =
          (static_cast<std::size_t>(node) + count_[k] - (spline_order / 2 - 1)) % count_[k];
      place.fraction[k] = at - node;
    }
    ++next[place.first[0] + 1];
  }
  for (std::size_t row = 1; row < next.size(); ++row) next[row] += next[row - 1];
  std::vector<Place> sorted(places.size());
  for (const Place& place : places) sorted[next[place.first[0]]++] = place;
  return sorted;
}

void DensityGrid::spread(const Place& place, const std::vector<Weights>& fields,
                         const std::vector<double*>& grids) const {
  const SplineValues across = spline_values(place.fraction[0]);
  const SplineValues along = spline_values(place.fraction[1]);
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const double weight = fields[f][place.point];
    if (weight == 0) continue;
    double* row = grids[f] + place.first[0] * row_ + place.first[1];
    for (int k = 0; k < spline_order; ++k, row += row_) {
      const double factor = weight * across[k];
      for (int l = 0; l < spline_order; ++l) row[l] += factor * along[l];
    }
  }
}

// What lies beyond the end of the period belongs to its beginning.
void DensityGrid::close_period(double* grid) const {
  const auto rows = static_cast<std::size_t>(count_[0]),
             columns = static_cast<std::size_t>(count_[1]);
  for (std::size_t x = 0; x < rows + spline_order; ++x)
    for (std::size_t y = 0; y < spline_order; ++y)
      grid[x * row_ + y] += grid[x * row_ + columns + y];
  for (std::size_t x = 0; x < spline_order; ++x)
    for (std::size_t y = 0; y < columns; ++y) grid[x * row_ + y] += grid[(rows + x) * row_ + y];
}

std::vector<Modes> DensityGrid::modes(std::span<const Vec2> positions,
                                      const std::vector<Weights>& fields) const {
  std::vector<Array<double>> memory;
  std::vector<double*> grids;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    memory.push_back(real_array(transform_->reals));
    grids.push_back(memory.back().get());
    std::fill_n(grids.back(), transform_->reals, 0.0);
  }
  for (const Place& place : places(positions)) spread(place, fields, grids);

  const Array<fftw_complex> out = complex_array(transform_->complexes);
  std::vector<Modes> result;
  for (double* grid : grids) {
    close_period(grid);
    fftw_execute_dft_r2c(transform_->plan, grid, out.get());
    Modes& modes = result.emplace_back(wave_vectors_.size());
    for (std::size_t k = 0; k < modes.size(); ++k) {
      const fftw_complex& mode = out[index_[k]];
      modes[k] = gain_[k] * std::complex<double>(mode[0], mode[1]);
    }
  }
  return result;
}

std::vector<Modes> direct_modes(const Vec2& lengths, std::span<const WaveVector> wave_vectors,
                                std::span<const Vec2> positions,
                                const std::vector<Weights>& fields) {
  int most_x = 0, most_y = 0;
  for (const WaveVector& q : wave_vectors) {
    most_x = std::max(most_x, std::abs(q.x));
    most_y = std::max(most_y, std::abs(q.y));
  }
  const auto waves = [](double phase, int most) {
    Modes wave;
    for (int n = -most; n <= most; ++n) wave.push_back(std::polar(1.0, -phase * n));
    return wave;
  };
  std::vector<Modes> result(fields.size(), Modes(wave_vectors.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Modes x = waves(2 * pi * positions[i].x() / lengths.x(), most_x);
    const Modes y = waves(2 * pi * positions[i].y() / lengths.y(), most_y);
    for (std::size_t k = 0; k < wave_vectors.size(); ++k) {
      const std::complex<double>& p = x[wave_vectors[k].x + most_x];
      const std::complex<double>& q = y[wave_vectors[k].y + most_y];
      // Written out: the operator's care for infinities takes several times as long.
      const std::complex<double> wave(p.real() * q.real() - p.imag() * q.imag(),
                                      p.real() * q.imag() + p.imag() * q.real());
      for (std::size_t f = 0; f < fields.size(); ++f) result[f][k] += fields[f][i] * wave;
    }
  }
  return result;
}

}  // namespace vitrel
