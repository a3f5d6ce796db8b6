#include "analysis/dynamics/velocity_correlation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "analysis/dynamics/like_particles.h"
#include "analysis/dynamics/tracks.h"
#include "core/parallel.h"

namespace vitrel {

namespace {

constexpr std::size_t max_origins = 128;
constexpr std::size_t max_spectrum_lags = 400;
/// Number of particles whose velocities stay in the cache.
constexpr std::size_t particles_at_once = 16;

/// The components of v of one particle at every frame, followed by those of ω if particles turn.
using Components = std::vector<FrameSeries>;
template <int Dim>
constexpr std::size_t angular_components = Dim == 2 ? 1 : 3;

double component(double omega, std::size_t) {
  return omega;
}
double component(const auto& v, std::size_t d) {
  return v[static_cast<int>(d)];
}

template <int Dim>
std::vector<Components> read_components(Trajectory<Dim>& trajectory, std::size_t begin,
                                        std::size_t end, std::size_t count) {
  std::vector<Components> particles(end - begin,
                                    Components(count, FrameSeries(trajectory.frames())));
  for (std::size_t k = 0; k < trajectory.frames(); ++k) {
    const Configuration<Dim>& frame = trajectory.read(k);
    const std::vector<Vec<Dim>> velocity = velocities_after_contact(frame);
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t d = 0; d < count; ++d)
        particles[i - begin][d][k] =
            d < Dim ? component(velocity[i], d) : component(frame.angular_velocity[i], d - Dim);
  }
  return particles;
}

/// Adds v² and v(0)·v(t) of one particle.
void add(MomentSum& sum, std::span<const FrameSeries> velocity, const Lag& lag,
         std::size_t its_class) {
  std::vector<double> squares(lag.origins), products(lag.origins);
  for (const FrameSeries& v : velocity)
    for (std::size_t k = 0; k < lag.origins; ++k) {
      const double now = v[lag.from(k)];
      squares[k] += now * now;
      products[k] += now * v[lag.to(k)];
    }
  sum.add(0, squares, products);
  sum.finish_particle(its_class);
}

/// The sums for v and for ω, one entry per lag.
struct VelocitySums {
  std::vector<MomentSum> translation, rotation;
};

/// Returns the sums of all particles. Threads share the lags, so that every sum adds up its particles in their order.
template <int Dim>
VelocitySums sums_of(Trajectory<Dim>& trajectory, const std::vector<Lag>& lags, bool rotates,
                     const DisplacementOptions& options, const ProgressReport& report) {
  const LikeParticles alike = like_particles(trajectory.read(0));
  const std::size_t n = trajectory.read(0).size();
  const std::size_t count = Dim + (rotates ? angular_components<Dim> : 0);
  const std::size_t batch = options.memory / (count * sizeof(double) * trajectory.frames()) + 1;
  VelocitySums sums;
  for (const Lag& lag : lags) sums.translation.emplace_back(lag.origins, alike.classes);
  if (rotates) sums.rotation = sums.translation;
  for (std::size_t begin = 0; begin < n; begin += batch) {
    const std::size_t end = std::min(begin + batch, n);
    const auto particles = read_components(trajectory, begin, end, count);
    for (std::size_t first = begin; first < end; first += particles_at_once)
      each_in_parallel(lags.size(), options.threads, [&](std::size_t l) {
        for (std::size_t i = first; i < std::min(first + particles_at_once, end); ++i) {
          const std::span<const FrameSeries> both = particles[i - begin];
          add(sums.translation[l], both.first(Dim), lags[l], alike.class_of[i]);
          if (rotates) add(sums.rotation[l], both.subspan(Dim), lags[l], alike.class_of[i]);
        }
      });
    const double done = static_cast<double>(end);
    if (report) report({done / static_cast<double>(n), done, "particles"});
  }
  return sums;
}

/// Returns the number of intervals M of the spectra, up to which every lag is one interval longer than the one before.
std::size_t spectrum_intervals(const std::vector<double>& times, const std::vector<Lag>& lags) {
  std::size_t last = 0;
  if (!evenly_spaced(times)) return 0;
  while (last < max_spectrum_lags && last + 1 < lags.size() && lags[last + 1].frames == last + 1)
    ++last;
  return last;
}

/// Returns g at ω_j from the lags 0 … M.
Estimate spectral_density(std::size_t j, const std::vector<MomentSum>& sums,
                          const std::vector<double>& correlation, std::span<const Lag> lags) {
  const std::size_t m = lags.size() - 1;
  const double angle = std::numbers::pi / static_cast<double>(m);
  const auto squares = sums[m].square.per_origin();
  double density = 0;
  std::vector<double> series(squares.size());
  for (std::size_t k = 0; k < m; ++k) {
    const double window = std::cos(0.5 * angle * static_cast<double>(k));
    const double weight = (k == 0 ? 1 : 2) * lags[1].time / std::numbers::pi * window * window *
                          std::cos(angle * static_cast<double>(j * k % (2 * m)));
    density += weight * correlation[k];
    const auto products = sums[k].quartic.per_origin();
    for (std::size_t o = 0; o < series.size(); ++o) series[o] += weight * products[o];
  }
  const double square = mean_of(squares);
  for (std::size_t o = 0; o < series.size(); ++o)
    series[o] = (series[o] - density * squares[o]) / square;
  return {density, average_of_decay(series, lags[m]).error, 0};
}

/// Returns the correlations, which have no values if nothing moves.
VelocityCorrelation evaluate(const std::vector<MomentSum>& sums, std::size_t particles,
                             const std::vector<Lag>& lags, std::size_t intervals) {
  VelocityCorrelation found;
  found.mean_square = mean_of(sums[0].square.per_origin()) / static_cast<double>(particles);
  if (!(found.mean_square > 0)) return found;
  for (std::size_t l = 0; l < lags.size(); ++l)
    found.correlation.push_back(sums[l].ratio(lags[l], particles));
  for (std::size_t j = 0; intervals > 0 && j <= intervals; ++j) {
    const Estimate density =
        spectral_density(j, sums, found.correlation.value, std::span(lags).first(intervals + 1));
    found.spectrum.mean.push_back(density.mean);
    found.spectrum.error.push_back(density.error);
  }
  return found;
}

}  // namespace

template <int Dim>
VelocityCorrelations velocity_correlations(Trajectory<Dim>& trajectory,
                                           const DisplacementOptions& options,
                                           const ProgressReport& report) {
  const std::size_t n = trajectory.read(0).size();
  TimeAxisOptions axis = options.axis;
  axis.max_origins = std::min(axis.max_origins, origins_for(n, max_origins));
  const std::vector<Lag> lags = lags_from_zero(trajectory.times(), axis);
  const std::size_t intervals = spectrum_intervals(trajectory.times(), lags);
  VelocityCorrelations result;
  const bool rotates = mechanics(trajectory.read(0)).rotational_energy > 0;
  const VelocitySums sums = sums_of(trajectory, lags, rotates, options, report);
  result.translation = evaluate(sums.translation, n, lags, intervals);
  if (rotates) result.rotation = evaluate(sums.rotation, n, lags, intervals);
  for (const Lag& lag : lags) {
    result.lag.push_back(lag.time);
    result.origins.push_back(lag.origins);
  }
  for (std::size_t j = 0; intervals > 0 && j <= intervals; ++j)
    result.frequency.push_back(std::numbers::pi * static_cast<double>(j) / lags[intervals].time);
  return result;
}

template VelocityCorrelations velocity_correlations(Trajectory2&, const DisplacementOptions&,
                                                    const ProgressReport&);
template VelocityCorrelations velocity_correlations(Trajectory3&, const DisplacementOptions&,
                                                    const ProgressReport&);

}  // namespace vitrel
