#include "analysis/structure/density_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "analysis/structure/fourier_arrays.h"

namespace vitrel {

namespace {

constexpr double pi = std::numbers::pi;

using SplineValues = std::array<double, spline_order>;

/// Returns the B-spline at the nodes around a point that lies `fraction` beyond the middle left one, from left to
/// right. The recursion goes over the order, upwards from 2.
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

/// Returns (sin(π x)/(π x))^p.
double transformed_spline(double x) {
  return x == 0 ? 1 : std::pow(std::sin(pi * x) / (pi * x), spline_order);
}

/// Adds weight × the splines of the axes from K on to the nodes from `grid` on.
template <std::size_t K, std::size_t Dim>
void add_splines(double* grid, double weight, const std::array<SplineValues, Dim>& splines,
                 const std::array<std::size_t, Dim>& pitch) {
  for (std::size_t k = 0; k < spline_order; ++k) {
    if constexpr (K + 1 == Dim)
      grid[k] += weight * splines[K][k];
    else
      add_splines<K + 1>(grid + k * pitch[K], weight * splines[K][k], splines, pitch);
  }
}

/// Advances to the next numbers, from −most to most, of all axes but the last one; the last of them changes fastest.
/// Returns false after the last.
template <std::size_t Dim>
bool advance(std::array<int, Dim>& n, const std::array<int, Dim>& most) {
  for (std::size_t k = Dim - 1; k-- > 0;) {
    if (n[k]++ < most[k]) return true;
    n[k] = -most[k];
  }
  return false;
}

double min_nodes(double length, double to) {
  return std::max<double>(spline_order, std::ceil(length * to / (2 * pi * largest_grid_wave)));
}

template <std::size_t Dim>
Vec<static_cast<int>(Dim)> as_vector(const std::array<int, Dim>& n) {
  Vec<static_cast<int>(Dim)> vector;
  for (std::size_t k = 0; k < Dim; ++k) vector[static_cast<Eigen::Index>(k)] = n[k];
  return vector;
}

/// The product is written out, because the operator takes several times as long for its care of infinities.
std::complex<double> product(const std::complex<double>& p, const std::complex<double>& q) {
  return {p.real() * q.real() - p.imag() * q.imag(), p.real() * q.imag() + p.imag() * q.real()};
}

}  // namespace

template <int Dim>
double alias_bound(const Vec<Dim>& x) {
  double product = 1;
  for (const double component : x) product *= sum_of_images(component);
  return product - 1;
}

/// The transform from a grid that goes on beyond the period in every direction to n_x × … × (n_last/2 + 1) modes.
template <int Dim>
struct DensityGrid<Dim>::Transform {
  explicit Transform(const std::array<int, Dim>& count) {
    std::array<int, Dim> in_size;
    for (std::size_t k = 0; k < Dim; ++k) {
      in_size[k] = count[k] + spline_order;
      reals *= static_cast<std::size_t>(in_size[k]);
      complexes *= static_cast<std::size_t>(k + 1 < Dim ? count[k] : count[k] / 2 + 1);
    }
    const FourierArray<double> in = real_array(reals);
    const FourierArray<fftw_complex> out = complex_array(complexes);
    plan.emplace(complexes, [&] {
      return fftw_plan_many_dft_r2c(Dim, count.data(), 1, in.get(), in_size.data(), 1, 0, out.get(),
                                    nullptr, 1, 0, FFTW_ESTIMATE);
    });
  }

  std::size_t reals = 1, complexes = 1;
  std::optional<FourierPlan> plan;
};

template <int Dim>
DensityGrid<Dim>::DensityGrid(const Vec<Dim>& lengths, double from, double to) : lengths_(lengths) {
  for (int k = 0; k < Dim; ++k) count_[k] = fast_size(static_cast<int>(min_nodes(lengths[k], to)));
  std::size_t pitch = 1;
  for (std::size_t k = Dim; k-- > 0;) {
    pitch_[k] = pitch;
    pitch *= static_cast<std::size_t>(count_[k] + spline_order);
  }
  transform_ = std::make_unique<Transform>(count_);
  list_wave_vectors(from, to);
}

template <int Dim>
DensityGrid<Dim>::~DensityGrid() = default;
template <int Dim>
DensityGrid<Dim>::DensityGrid(DensityGrid&&) noexcept = default;

template <int Dim>
double DensityGrid<Dim>::nodes(const Vec<Dim>& lengths, double to) {
  double nodes = 1;
  for (const double length : lengths) nodes *= min_nodes(length, to);
  return nodes;
}

template <int Dim>
Vec<Dim> DensityGrid<Dim>::spacing() const {
  Vec<Dim> spacing = lengths_;
  for (int k = 0; k < Dim; ++k) spacing[k] /= count_[k];
  return spacing;
}

template <int Dim>
void DensityGrid<Dim>::list_wave_vectors(double from, double to) {
  WaveVector<Dim> first{};
  std::array<int, Dim> most;
  for (int k = 0; k < Dim; ++k) {
    most[k] = static_cast<int>(to * lengths_[k] / (2 * pi));
    first.n[k] = -most[k];
  }
  do list_row(first, from, to);
  while (advance(first.n, most));
}

/// Lists the wave vectors that begin with the same numbers, as long as their last number other than 0 is positive.
template <int Dim>
void DensityGrid<Dim>::list_row(WaveVector<Dim> wave, double from, double to) {
  const Vec<Dim> unit = 2 * pi * lengths_.cwiseInverse();
  const auto last = std::find_if(wave.n.rbegin() + 1, wave.n.rend(), [](int n) { return n != 0; });
  for (int& n = wave.n.back() = last != wave.n.rend() && *last > 0 ? 0 : 1;; ++n) {
    wave.wave_number = unit.cwiseProduct(as_vector(wave.n)).norm();
    if (wave.wave_number >= to) break;
    if (wave.wave_number >= from) list(wave);
  }
}

template <int Dim>
void DensityGrid<Dim>::list(const WaveVector<Dim>& wave) {
  std::size_t index = 0;
  int sum = 0;
  double spline = 1;
  for (std::size_t k = 0; k < Dim; ++k) {
    const int n = wave.n[k], count = count_[k];
    index = index * static_cast<std::size_t>(k + 1 < Dim ? count : count / 2 + 1) +
            static_cast<std::size_t>(n < 0 ? n + count : n);
    sum += n;
    spline *= transformed_spline(static_cast<double>(n) / count);
  }
  wave_vectors_.push_back(wave);
  index_.push_back(index);
  gain_.push_back((sum % 2 == 0 ? 1 : -1) / spline);
}

/// The place of a point: the first of its p nodes in every direction, and how far it lies beyond the middle left one.
template <int Dim>
struct DensityGrid<Dim>::Place {
  std::size_t point;
  std::size_t first[Dim];
  double fraction[Dim];
};

// The places are sorted along the first axis: points next to each other then write to the same part of the grid, which
// stays in the cache.
template <int Dim>
std::vector<typename DensityGrid<Dim>::Place> DensityGrid<Dim>::places(
    std::span<const Vec<Dim>> positions) const {
  std::vector<Place> places;
  std::vector<std::size_t> next(static_cast<std::size_t>(count_[0]) + 1, 0);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Place& place = places.emplace_back(Place{i, {}, {}});
    for (int k = 0; k < Dim; ++k) {
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

template <int Dim>
void DensityGrid<Dim>::spread(const Place& place, const std::vector<Weights>& fields,
                              const std::vector<double*>& grids) const {
  std::array<SplineValues, Dim> splines;
  std::size_t first = 0;
  for (std::size_t k = 0; k < Dim; ++k) {
    splines[k] = spline_values(place.fraction[k]);
    first += place.first[k] * pitch_[k];
  }
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const double weight = fields[f][place.point];
    if (weight != 0) add_splines<0>(grids[f] + first, weight, splines, pitch_);
  }
}

// What lies beyond the end of the period belongs to its beginning.
template <int Dim>
void DensityGrid<Dim>::close_period(double* grid) const {
  for (std::size_t k = Dim; k-- > 0;) {
    const std::size_t period = static_cast<std::size_t>(count_[k]) * pitch_[k];
    const std::size_t beyond = spline_order * pitch_[k];
    for (std::size_t line = 0; line < transform_->reals; line += period + beyond)
      for (std::size_t at = line; at < line + beyond; ++at) grid[at] += grid[at + period];
  }
}

template <int Dim>
std::vector<Modes> DensityGrid<Dim>::modes(std::span<const Vec<Dim>> positions,
                                           const std::vector<Weights>& fields) const {
  std::vector<FourierArray<double>> memory;
  std::vector<double*> grids;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    memory.push_back(real_array(transform_->reals));
    grids.push_back(memory.back().get());
    std::fill_n(grids.back(), transform_->reals, 0.0);
  }
  for (const Place& place : places(positions)) spread(place, fields, grids);

  const FourierArray<fftw_complex> out = complex_array(transform_->complexes);
  std::vector<Modes> result;
  for (double* grid : grids) {
    close_period(grid);
    fftw_execute_dft_r2c(transform_->plan->get(), grid, out.get());
    Modes& modes = result.emplace_back(wave_vectors_.size());
    for (std::size_t k = 0; k < modes.size(); ++k) {
      const fftw_complex& mode = out[index_[k]];
      modes[k] = gain_[k] * std::complex<double>(mode[0], mode[1]);
    }
  }
  return result;
}

template <int Dim>
std::vector<Modes> direct_modes(const Vec<Dim>& lengths,
                                const std::vector<WaveVector<Dim>>& wave_vectors,
                                const std::vector<Vec<Dim>>& positions,
                                const std::vector<Weights>& fields) {
  std::array<int, Dim> most{};
  for (const WaveVector<Dim>& q : wave_vectors)
    for (std::size_t k = 0; k < Dim; ++k) most[k] = std::max(most[k], std::abs(q.n[k]));
  std::vector<Modes> result(fields.size(), Modes(wave_vectors.size()));
  std::array<Modes, Dim> waves;  // exp(−2πi n r/L) from n = −most to most
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (std::size_t k = 0; k < Dim; ++k) {
      const double phase = 2 * pi * positions[i][k] / lengths[k];
      waves[k].clear();
      for (int n = -most[k]; n <= most[k]; ++n) waves[k].push_back(std::polar(1.0, -phase * n));
    }
    for (std::size_t q = 0; q < wave_vectors.size(); ++q) {
      const std::array<int, Dim>& n = wave_vectors[q].n;
      std::complex<double> wave = waves[0][n[0] + most[0]];
      for (std::size_t k = 1; k < Dim; ++k) wave = product(wave, waves[k][n[k] + most[k]]);
      for (std::size_t f = 0; f < fields.size(); ++f) result[f][q] += fields[f][i] * wave;
    }
  }
  return result;
}

template double alias_bound<2>(const Vec<2>&);
template class DensityGrid<2>;
template std::vector<Modes> direct_modes<2>(const Vec<2>&, const std::vector<WaveVector<2>>&,
                                            const std::vector<Vec<2>>&,
                                            const std::vector<Weights>&);
template double alias_bound<3>(const Vec<3>&);
template class DensityGrid<3>;
template std::vector<Modes> direct_modes<3>(const Vec<3>&, const std::vector<WaveVector<3>>&,
                                            const std::vector<Vec<3>>&,
                                            const std::vector<Weights>&);

}  // namespace vitrel
