#include "analysis/dynamics/cage_relative.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "analysis/dynamics/bessel_j0.h"
#include "analysis/dynamics/displacement.h"
#include "analysis/dynamics/like_particles.h"
#include "analysis/structure/voronoi.h"
#include "core/error.h"
#include "core/neighbors/spatial_order.h"
#include "core/parallel.h"

namespace vitrel {

namespace {

constexpr std::size_t max_origins = 256;

/// Bytes for a particle: six neighbours on the average, and the number at which they begin.
constexpr double neighbor_bytes = 6 * sizeof(std::uint32_t) + sizeof(std::uint32_t);

/// The neighbours of all particles at one time.
struct Cages {
  std::vector<std::uint32_t> first;  ///< where the neighbours of every particle begin, and the end
  std::vector<std::uint32_t> neighbors;
};

/// Returns the cages of a frame. Particles are numbered by their places in `order`.
Cages cages(const Configuration2& frame, const std::vector<std::uint32_t>& order) {
  const Voronoi voronoi(frame);
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) place[order[k]] = k;
  Cages found;
  found.first.reserve(order.size() + 1);
  found.neighbors.reserve(6 * order.size());
  for (const std::uint32_t i : order) {
    found.first.push_back(static_cast<std::uint32_t>(found.neighbors.size()));
    for (const VoronoiEdge& edge : voronoi.cell(i).edges)
      if (edge.neighbor != i) found.neighbors.push_back(place[edge.neighbor]);
  }
  found.first.push_back(static_cast<std::uint32_t>(found.neighbors.size()));
  return found;
}

/// Returns which frames are origins of some lag.
std::vector<bool> origins_of(const std::vector<Lag>& lags, std::size_t frames) {
  std::vector<bool> is_origin(frames, false);
  for (const Lag& lag : lags)
    for (std::size_t k = 0; k < lag.origins; ++k) is_origin[lag.from(k)] = true;
  return is_origin;
}

void tell(const ProgressReport& report, std::size_t done, std::size_t of, const char* quantity) {
  const double share = static_cast<double>(done) / static_cast<double>(of);
  if (report) report({share, static_cast<double>(done), quantity});
}

/// All positions, and the cages at the origins. Particles are numbered by their places in `order`, in which neighbours
/// are near in memory.
class Recording {
 public:
  Recording(Trajectory2& trajectory, const std::vector<std::uint32_t>& order,
            const std::vector<bool>& is_origin, const ProgressReport& report)
      : positions_(trajectory.frames()), cages_(trajectory.frames()) {
    for (std::size_t k = 0; k < trajectory.frames(); ++k) {
      const Configuration2& frame = trajectory.read_places(k);
      positions_[k].reserve(order.size());
      for (const std::uint32_t i : order) positions_[k].push_back(frame.unwrapped(i));
      if (is_origin[k]) cages_[k] = cages(frame, order);
      tell(report, k + 1, trajectory.frames(), "frames");
    }
  }

  std::size_t particles() const { return positions_.front().size(); }

  /// Computes |Δr_c|² of all particles. `moved` is working space for their displacements.
  void square(std::size_t from, std::size_t to, std::vector<Vec2>& moved,
              std::vector<double>& squares) const {
    const Cages& cage = cages_[from];
    for (std::size_t i = 0; i < moved.size(); ++i)
      moved[i] = positions_[to][i] - positions_[from][i];
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const std::uint32_t begin = cage.first[i], end = cage.first[i + 1];
      Vec2 around = Vec2::Zero();
      for (std::uint32_t n = begin; n < end; ++n) around += moved[cage.neighbors[n]];
      if (end > begin) around /= end - begin;
      squares[i] = (moved[i] - around).squaredNorm();
    }
  }

 private:
  std::vector<std::vector<Vec2>> positions_;  ///< [frame][particle], unwrapped
  std::vector<Cages> cages_;                  ///< [frame]; empty except at origins
};

bool fits(const std::vector<bool>& is_origin, std::size_t particles, std::size_t memory) {
  const auto origins = static_cast<double>(std::ranges::count(is_origin, true));
  const double bytes =
      static_cast<double>(is_origin.size()) * sizeof(Vec2) + origins * neighbor_bytes;
  return bytes * static_cast<double>(particles) <= static_cast<double>(memory);
}

/// One quantity at one lag.
struct Quantity {
  Quantity(const Lag& lag, const LikeParticles& alike)
      : sum(lag.origins, alike.classes), of_particles(alike.class_of.size()) {}
  CorrelationSum sum;
  std::vector<double> of_particles;  ///< sums over the origins
};

/// The sums of one lag over all particles.
struct LagResult {
  LagResult(const Lag& lag, std::size_t wave_numbers, const LikeParticles& alike)
      : square(lag, alike), overlap(lag, alike), scattering(wave_numbers, Quantity(lag, alike)) {}
  Quantity square, overlap;
  std::vector<Quantity> scattering;

  void finish(const LikeParticles& alike) {
    const auto finish_one = [&](Quantity& quantity) {
      quantity.sum.finish_particles(quantity.of_particles, alike.class_of);
      quantity.of_particles = {};
    };
    finish_one(square);
    finish_one(overlap);
    std::ranges::for_each(scattering, finish_one);
  }
};

LagResult measure(const Recording& recording, const LikeParticles& alike, const Lag& lag,
                  const std::vector<double>& wave_numbers, double overlap_distance,
                  const BesselJ0& bessel) {
  LagResult result(lag, wave_numbers.size(), alike);
  const std::size_t n = recording.particles();
  std::vector<Vec2> moved(n);
  std::vector<double> squares(n), values(n);
  for (std::size_t k = 0; k < lag.origins; ++k) {
    const auto add = [&](Quantity& quantity, auto&& value) {
      std::ranges::transform(squares, values.begin(), value);
      quantity.sum.add_origin(k, values, quantity.of_particles);
    };
    recording.square(lag.from(k), lag.to(k), moved, squares);
    result.square.sum.add_origin(k, squares, result.square.of_particles);
    add(result.overlap, [near = overlap_distance * overlap_distance](double square) {
      return square < near ? 1.0 : 0.0;
    });
    for (std::size_t j = 0; j < wave_numbers.size(); ++j)
      add(result.scattering[j],
          [&bessel, q = wave_numbers[j]](double square) { return bessel(q * std::sqrt(square)); });
  }
  result.finish(alike);
  return result;
}

}  // namespace

std::optional<CageRelative> cage_relative(Trajectory2& trajectory,
                                          const DisplacementOptions& options,
                                          const ProgressReport& report) {
  if (trajectory.frames() < 2)
    throw UserError("cage-relative displacements: at least two frames are needed");
  const Configuration2& first = trajectory.read_places(0);
  TimeAxisOptions axis = options.axis;
  axis.max_origins = std::min(axis.max_origins, origins_for(first.size(), max_origins, 8));
  const std::vector<Lag> lags = time_axis_of_motion(trajectory, axis);
  const std::vector<bool> is_origin = origins_of(lags, trajectory.frames());
  if (!fits(is_origin, first.size(), options.memory)) return std::nullopt;
  CageRelative result;
  result.wave_numbers = wave_numbers_or_main(options.wave_numbers, first);
  result.self_scattering.resize(result.wave_numbers.size());
  const std::vector<std::uint32_t> order = spatial_order<2>(first.box, first.position);
  LikeParticles alike = like_particles(first);
  std::ranges::transform(order, alike.class_of.begin(),
                         [of = alike.class_of](std::uint32_t i) { return of[i]; });
  const Recording recording(trajectory, order, is_origin, report);
  const std::size_t n = recording.particles();
  const BesselJ0 bessel;
  std::vector<std::optional<LagResult>> sums(lags.size());
  const auto caller = std::this_thread::get_id();
  std::atomic<std::size_t> done = 0;
  each_in_parallel(lags.size(), options.threads, [&](std::size_t l) {
    sums[l] =
        measure(recording, alike, lags[l], result.wave_numbers, options.overlap_distance, bessel);
    const std::size_t so_far = ++done;
    if (std::this_thread::get_id() == caller) tell(report, so_far, lags.size(), "lags");
  });
  for (std::size_t l = 0; l < lags.size(); ++l) {
    result.lag.push_back(lags[l].time);
    result.origins.push_back(lags[l].origins);
    result.square.push_back(sums[l]->square.sum.estimate(lags[l], n));
    result.overlap.push_back(sums[l]->overlap.sum.estimate(lags[l], n));
    result.susceptibility.push_back(susceptibility(sums[l]->overlap.sum, lags[l], n));
    for (std::size_t j = 0; j < result.wave_numbers.size(); ++j)
      result.self_scattering[j].push_back(sums[l]->scattering[j].sum.estimate_of_decay(lags[l], n));
  }
  return result;
}

}  // namespace vitrel
