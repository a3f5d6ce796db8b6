#include "analysis/dynamics/collective_scattering.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "analysis/dynamics/density_modes.h"
#include "core/error.h"
#include "core/parallel.h"

namespace vitrel {

namespace {

constexpr std::size_t max_vectors = 32;

/// Number of frames held in memory for the threads to share.
constexpr std::size_t frames_at_once = 32;

template <int Dim>
double length_of(const std::array<int, Dim>& n, const Vec<Dim>& unit) {
  if constexpr (Dim == 2)
    return std::hypot(n[0] * unit[0], n[1] * unit[1]);
  else
    return std::hypot(n[0] * unit[0], n[1] * unit[1], n[2] * unit[2]);
}

/// ρ(t) of every wave vector: [vector][frame].
using Series = std::vector<std::vector<std::complex<double>>>;

template <int Dim>
Series read_modes(Trajectory<Dim>& trajectory, const std::vector<std::array<int, Dim>>& vectors,
                  int threads, const ProgressReport& report) {
  const std::size_t frames = trajectory.frames();
  const Vec<Dim> lengths = trajectory.read_places(0).box.lengths();
  const DensityModes<Dim> modes(vectors, PeriodicBox<Dim>(lengths));
  Series series(vectors.size(), std::vector<std::complex<double>>(frames));
  std::vector<std::vector<Vec<Dim>>> positions(frames_at_once);
  for (std::size_t begin = 0; begin < frames; begin += frames_at_once) {
    const std::size_t count = std::min(frames_at_once, frames - begin);
    for (std::size_t k = 0; k < count; ++k) {
      const Configuration<Dim>& frame = trajectory.read_places(begin + k);
      if (frame.box.lengths() != lengths)
        throw UserError("collective scattering: the box of frame " + std::to_string(begin + k) +
                        " differs from that of the first; it must stay the same");
      positions[k] = frame.position;
    }
    each_in_parallel(count, threads, [&](std::size_t k) {
      const auto sums = modes.of(positions[k]);
      for (std::size_t v = 0; v < sums.size(); ++v) series[v][begin + k] = sums[v];
    });
    const double done = static_cast<double>(begin + count);
    if (report) report({done / static_cast<double>(frames), done, "frames"});
  }
  return series;
}

/// Returns F of the wave vectors first … first + count − 1.
Correlation correlate(const Series& series, std::size_t first, std::size_t count,
                      const std::vector<Lag>& lags, std::size_t particles) {
  Correlation result;
  std::vector<double> products;
  for (const Lag& lag : lags) {
    CorrelationSum sum(lag.origins);
    products.resize(lag.origins);
    for (std::size_t v = first; v < first + count; ++v) {
      for (std::size_t k = 0; k < lag.origins; ++k) {
        const std::complex<double> now = series[v][lag.from(k)];
        const std::complex<double> then = series[v][lag.to(k)];
        products[k] =
            (now.real() * then.real() + now.imag() * then.imag()) / static_cast<double>(particles);
      }
      sum.add(0, products);
      sum.finish_particle();
    }
    result.push_back(sum.estimate_with_plateau(lag, count));
  }
  return result;
}

/// Calls visit(n) for all n with |q| within `reach` of a wave number, and for some n beside them. It visits only those
/// whose first component other than 0 is positive, in ascending order. The cost is O((q L)^(D−1)), since the last
/// component skips the inside of the shell.
template <int Dim, class Visit>
void for_each_near(const Vec<Dim>& unit, double wave_number, double reach, Visit&& visit) {
  std::array<int, Dim> n;
  // Returns the steps along an axis from the middle plane to a sphere whose squared radius is partly used up by the
  // other components.
  const auto steps = [&](double radius, double used, int axis) {
    return static_cast<int>(std::sqrt(std::max(0.0, radius * radius - used)) / unit[axis]);
  };
  const auto choose = [&](auto&& self, int axis, double used, bool positive) -> void {
    const bool is_last = axis + 1 == Dim;
    const int outside = steps(wave_number + reach, used, axis) + 1;
    const int inside = is_last ? steps(std::max(0.0, wave_number - reach), used, axis) - 1 : 0;
    for (int k = positive ? -outside : is_last; k <= outside; ++k) {
      if (k > -inside && k < inside) k = inside;
      n[static_cast<std::size_t>(axis)] = k;
      const double q = k * unit[axis];
      if (is_last)
        visit(n);
      else
        self(self, axis + 1, used + q * q, positive || k > 0);
    }
  };
  choose(choose, 0, 0.0, false);
}

/// The max_vectors with the smallest distances, the smallest first; among equal ones, those added first.
template <int Dim>
class NearestVectors {
 public:
  void add(const std::array<int, Dim>& n, double distance) {
    const auto place = std::ranges::upper_bound(distances_, distance);
    vectors_.insert(vectors_.begin() + (place - distances_.begin()), n);
    distances_.insert(place, distance);
    if (vectors_.size() <= max_vectors) return;
    vectors_.pop_back();
    distances_.pop_back();
  }
  std::vector<std::array<int, Dim>> vectors() && { return std::move(vectors_); }

 private:
  std::vector<double> distances_;
  std::vector<std::array<int, Dim>> vectors_;
};

}  // namespace

template <int Dim>
WaveVectorShell<Dim> wave_vector_shell(const PeriodicBox<Dim>& box, double wave_number) {
  const Vec<Dim> unit = reciprocal_lengths(box);
  const double reach = 0.5 * unit.minCoeff();
  NearestVectors<Dim> nearest;
  for_each_near<Dim>(unit, wave_number, reach, [&](const std::array<int, Dim>& n) {
    const double distance = std::abs(length_of<Dim>(n, unit) - wave_number);
    if (distance <= reach) nearest.add(n, distance);
  });
  WaveVectorShell<Dim> shell{std::move(nearest).vectors(), 0};
  if (shell.n.empty())
    throw UserError(
        "the wave number " + std::to_string(wave_number) +
        " is too small for the box; the smallest is 2π/L = " + std::to_string(unit.minCoeff()));
  for (const auto& n : shell.n) shell.wave_number += length_of<Dim>(n, unit);
  shell.wave_number /= static_cast<double>(shell.n.size());
  return shell;
}

template <int Dim>
CollectiveScattering collective_scattering(Trajectory<Dim>& trajectory,
                                           std::span<const double> wave_numbers,
                                           const TimeAxisOptions& axis,
                                           const ProgressReport& report, int threads) {
  const std::vector<double>& times = trajectory.times();
  if (times.empty()) throw UserError("collective scattering: the run holds no frames");
  CollectiveScattering result;
  std::vector<std::array<int, Dim>> vectors;
  const Configuration<Dim>& first = trajectory.read_places(0);
  const std::size_t particles = first.size();
  for (const double q : wave_numbers) {
    const WaveVectorShell<Dim> shell = wave_vector_shell(first.box, q);
    result.wave_numbers.push_back(shell.wave_number);
    result.modes.push_back(shell.n.size());
    vectors.insert(vectors.end(), shell.n.begin(), shell.n.end());
  }
  const Series series = read_modes<Dim>(trajectory, vectors, threads, report);
  const std::vector<Lag> lags = lags_from_zero(times, axis);
  for (const Lag& lag : lags) {
    result.lag.push_back(lag.time);
    result.origins.push_back(lag.origins);
  }
  std::size_t begin = 0;
  for (const std::size_t count : result.modes) {
    result.scattering.push_back(correlate(series, begin, count, lags, particles));
    begin += count;
  }
  return result;
}

template WaveVectorShell<2> wave_vector_shell(const PeriodicBox<2>&, double);
template WaveVectorShell<3> wave_vector_shell(const PeriodicBox<3>&, double);
template CollectiveScattering collective_scattering(Trajectory2&, std::span<const double>,
                                                    const TimeAxisOptions&, const ProgressReport&,
                                                    int);
template CollectiveScattering collective_scattering(Trajectory3&, std::span<const double>,
                                                    const TimeAxisOptions&, const ProgressReport&,
                                                    int);

}  // namespace vitrel
