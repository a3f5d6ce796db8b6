#include "analysis/dynamics/collective_scattering.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/parallel.h"

namespace vitrel {

namespace {

constexpr std::size_t max_vectors = 32;

/// Frames held in memory for the threads to share.
constexpr std::size_t frames_at_once = 32;

/// Particles whose phases stay in the cache.
constexpr std::size_t block = 32;

Vec2 reciprocal(const PeriodicBox<2>& box) {
  return 2 * std::numbers::pi * box.lengths().cwiseInverse();
}

double length_of(const std::array<int, 2>& n, const Vec2& unit) {
  return std::hypot(n[0] * unit.x(), n[1] * unit.y());
}

/// exp(i n φ) of a block of particles for n = 0 … order; real and imaginary parts apart.
class Powers {
 public:
  explicit Powers(int order)
      : real_((static_cast<std::size_t>(order) + 1) * block), imaginary_(real_.size()) {
    std::fill_n(real_.begin(), block, 1.0);
  }

  void set(std::size_t p, double phase) {
    if (real_.size() == block) return;
    real_[block + p] = std::cos(phase);
    imaginary_[block + p] = std::sin(phase);
  }
  void multiply() {
    const double *re = real_.data(), *im = imaginary_.data();
    for (std::size_t from = block; from + block < real_.size(); from += block)
      for (std::size_t p = 0; p < block; ++p) {
        const double c = re[from + p], s = im[from + p];
        real_[from + block + p] = c * re[block + p] - s * im[block + p];
        imaginary_[from + block + p] = c * im[block + p] + s * re[block + p];
      }
  }
  const double* real(int n) const { return &real_[static_cast<std::size_t>(n) * block]; }
  const double* imaginary(int n) const { return &imaginary_[static_cast<std::size_t>(n) * block]; }

 private:
  std::vector<double> real_, imaginary_;
};

/// ρ_q of one frame for all wave vectors.
class Modes {
 public:
  Modes(const std::vector<std::array<int, 2>>& vectors, const Vec2& unit)
      : vectors_(vectors), unit_(unit) {
    for (const auto& n : vectors)
      for (const std::size_t d : {0, 1}) order_[d] = std::max(order_[d], std::abs(n[d]));
  }

  std::vector<std::complex<double>> of(const std::vector<Vec2>& positions) const {
    std::vector<std::complex<double>> sums(vectors_.size());
    Powers x(order_[0]), y(order_[1]);
    for (std::size_t begin = 0; begin < positions.size(); begin += block) {
      const std::size_t count = std::min(block, positions.size() - begin);
      for (std::size_t p = 0; p < count; ++p) {
        x.set(p, unit_.x() * positions[begin + p].x());
        y.set(p, unit_.y() * positions[begin + p].y());
      }
      x.multiply();
      y.multiply();
      for (std::size_t v = 0; v < vectors_.size(); ++v) sums[v] += sum(x, y, vectors_[v], count);
    }
    return sums;
  }

 private:
  static std::complex<double> sum(const Powers& x, const Powers& y, const std::array<int, 2>& n,
                                  std::size_t count) {
    const double *xr = x.real(n[0]), *xi = x.imaginary(n[0]);
    const double *yr = y.real(std::abs(n[1])), *yi = y.imaginary(std::abs(n[1]));
    const double sign = n[1] < 0 ? -1 : 1;
    double real[2] = {}, imaginary[2] = {};  // even and odd particles, added at once
    for (std::size_t p = 0; p < count; ++p) {
      real[p % 2] += xr[p] * yr[p] - sign * xi[p] * yi[p];
      imaginary[p % 2] += xi[p] * yr[p] + sign * xr[p] * yi[p];
    }
    return {real[0] + real[1], imaginary[0] + imaginary[1]};
  }

  const std::vector<std::array<int, 2>>& vectors_;
  Vec2 unit_;
  std::array<int, 2> order_{};
};

/// ρ(t) of every wave vector: [vector][frame].
using Series = std::vector<std::vector<std::complex<double>>>;

Series read_modes(Trajectory& trajectory, const std::vector<std::array<int, 2>>& vectors,
                  int threads, const ProgressReport& report) {
  const std::size_t frames = trajectory.frames();
  const Vec2 lengths = trajectory.read(0).box.lengths();
  const Modes modes(vectors, reciprocal(PeriodicBox<2>(lengths)));
  Series series(vectors.size(), std::vector<std::complex<double>>(frames));
  std::vector<std::vector<Vec2>> positions(frames_at_once);
  for (std::size_t begin = 0; begin < frames; begin += frames_at_once) {
    const std::size_t count = std::min(frames_at_once, frames - begin);
    for (std::size_t k = 0; k < count; ++k) {
      const Configuration2& frame = trajectory.read(begin + k);
      if (frame.box.lengths() != lengths)
        throw UserError("collective scattering: the box of frame " + std::to_string(begin + k) +
                        " differs from that of the first; it must stay the same");
      positions[k] = frame.position;
    }
    in_parallel(count, threads, [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) {
        const auto sums = modes.of(positions[k]);
        for (std::size_t v = 0; v < sums.size(); ++v) series[v][begin + k] = sums[v];
      }
    });
    const double done = static_cast<double>(begin + count);
    if (report) report({done / static_cast<double>(frames), done, "frames"});
  }
  return series;
}

/// Time difference 0 before those of the time axis: from all frames if they are evenly spaced, else from
/// the origins of the shortest lag, for unevenly sampled stretches count according to their length.
std::vector<Lag> lags_from_zero(std::span<const double> times, const TimeAxisOptions& axis) {
  std::vector<Lag> lags = time_axis(times, axis);
  Lag zero{};
  if (lags.empty() || lags.front().pairs.empty()) {
    const std::size_t stride = (times.size() + axis.max_origins - 1) / axis.max_origins;
    zero = {0, stride, (times.size() - 1) / stride + 1};
  } else {
    zero = lags.front();
    zero.time = 0;
    for (FramePair& pair : zero.pairs) pair.to = pair.from;
  }
  lags.insert(lags.begin(), std::move(zero));
  return lags;
}

/// F of the wave vectors first … first + count − 1.
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

}  // namespace

WaveVectorShell wave_vector_shell(const PeriodicBox<2>& box, double wave_number) {
  const Vec2 unit = reciprocal(box);
  const double reach = 0.5 * unit.minCoeff();
  const int max_x = static_cast<int>((wave_number + reach) / unit.x());
  const int max_y = static_cast<int>((wave_number + reach) / unit.y());
  const auto away = [&](const std::array<int, 2>& n) {
    return std::abs(length_of(n, unit) - wave_number);
  };
  WaveVectorShell shell{{}, 0};
  for (int x = 0; x <= max_x; ++x)
    for (int y = x == 0 ? 1 : -max_y; y <= max_y; ++y)
      if (away({x, y}) <= reach) shell.n.push_back({x, y});
  if (shell.n.empty())
    throw UserError(
        "the wave number " + std::to_string(wave_number) +
        " is too small for the box; the smallest is 2π/L = " + std::to_string(unit.minCoeff()));
  std::stable_sort(shell.n.begin(), shell.n.end(),
                   [&](const auto& a, const auto& b) { return away(a) < away(b); });
  if (shell.n.size() > max_vectors) shell.n.resize(max_vectors);
  for (const auto& n : shell.n) shell.wave_number += length_of(n, unit);
  shell.wave_number /= static_cast<double>(shell.n.size());
  return shell;
}

CollectiveScattering collective_scattering(Trajectory& trajectory,
                                           std::span<const double> wave_numbers,
                                           const TimeAxisOptions& axis,
                                           const ProgressReport& report, int threads) {
  const std::vector<double>& times = trajectory.times();
  if (times.empty()) throw UserError("collective scattering: the run holds no frames");
  CollectiveScattering result;
  std::vector<std::array<int, 2>> vectors;
  const Configuration2& first = trajectory.read(0);
  const std::size_t particles = first.size();
  for (const double q : wave_numbers) {
    result.shells.push_back(wave_vector_shell(first.box, q));
    vectors.insert(vectors.end(), result.shells.back().n.begin(), result.shells.back().n.end());
  }
  const Series series = read_modes(trajectory, vectors, threads, report);
  const std::vector<Lag> lags = lags_from_zero(times, axis);
  for (const Lag& lag : lags) {
    result.lag.push_back(lag.time);
    result.origins.push_back(lag.origins);
  }
  std::size_t begin = 0;
  for (const WaveVectorShell& shell : result.shells) {
    result.scattering.push_back(correlate(series, begin, shell.n.size(), lags, particles));
    begin += shell.n.size();
  }
  return result;
}

}  // namespace vitrel
