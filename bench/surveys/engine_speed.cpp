#include "bench/surveys/engine_speed.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>
#include <numeric>

#include "bench/methods/collision_case.h"
#include "core/error.h"
#include "core/random/stream.h"
#include "edmd/brownian.h"
#include "mc/insertion.h"
#include "mc/sampler.h"
#include "mc/swelling.h"

namespace vitrel::bench {
namespace {

// Returns a random permutation of 0 … n − 1.
std::vector<std::size_t> random_order(std::size_t n) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Stream draw(n, Purpose::benchmark_cases);
  for (std::size_t k = n; k > 1; --k) std::swap(order[k - 1], order[draw.below(k)]);
  return order;
}

}  // namespace

void must_reach(const StageReport& report) {
  if (report.end != StageEnd::reached)
    throw InvariantError("no state to measure: " + report.reason);
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Configuration2 fluid(const FluidScene& scene) {
  return liquid(of_unit_area(scene.aspect_ratio), scene.particles, scene.packing_fraction,
                scene.seed);
}

template <class Shape>
Configuration<Shape::dimension> liquid(const Shape& shape, int particles, double packing_fraction,
                                       std::uint64_t seed) {
  constexpr double dilute = Shape::dimension == 2 ? 0.2 : 0.1;
  constexpr int sweeps = 500, sweeps_between_tunings = 10;
  Configuration<Shape::dimension> c;
  c.resize(static_cast<std::size_t>(particles));
  c.species_names = {"A"};
  std::ranges::fill(c.shape, shape);
  must_reach(insert_particles(c, {std::min(dilute, packing_fraction)}, seed, {}));
  SwellingState swelling;
  must_reach(swell(c, {packing_fraction}, seed, swelling, {}));
  Sampler sampler(c, seed, {.next_sweep = swelling.moves.next_sweep});
  for (int k = 1; k <= sweeps; ++k) {
    sampler.sweep();
    if (k % sweeps_between_tunings == 0) sampler.tune();
  }
  draw_velocities(c, seed, Purpose::velocities, 0, Temperature::total);
  return c;
}

template Configuration2 liquid(const Ellipse&, int, double, std::uint64_t);
template Configuration3 liquid(const Ellipsoid&, int, double, std::uint64_t);

template <int Dim>
Configuration<Dim> gas(int particles, double packing_fraction, std::uint64_t seed) {
  Configuration<Dim> c;
  c.resize(static_cast<std::size_t>(particles));
  c.species_names = {"A"};
  must_reach(insert_particles(c, {packing_fraction}, seed, {}));
  draw_velocities(c, seed, Purpose::velocities, 0, Temperature::total);
  return c;
}

template Configuration2 gas<2>(int, double, std::uint64_t);
template Configuration3 gas<3>(int, double, std::uint64_t);

Configuration2 tiled(const Configuration2& tile, int columns, int rows) {
  const Vec2 lengths = tile.box.lengths();
  const auto per_row = static_cast<std::size_t>(columns);
  const std::size_t copies = per_row * static_cast<std::size_t>(rows);
  const std::vector<std::size_t> place = random_order(copies * tile.size());
  Configuration2 c;
  c.box = PeriodicBox<2>(Vec2(columns * lengths.x(), rows * lengths.y()));
  c.resize(place.size());
  c.species_names = tile.species_names;
  for (std::size_t k = 0; k < place.size(); ++k) {
    const std::size_t i = k % tile.size(), copy = k / tile.size();
    const std::size_t column = copy % per_row, row = copy / per_row;
    const Vec2 corner(static_cast<double>(column), static_cast<double>(row));
    const std::size_t at = place[k];
    c.position[at] = tile.position[i] + corner.cwiseProduct(lengths);
    c.box.wrap(c.position[at], c.image[at]);
    c.angle[at] = tile.angle[i];
    c.shape[at] = tile.shape[i];
    c.mass[at] = tile.mass[i];
  }
  draw_velocities(c, 1, Purpose::velocities, 0, Temperature::total);
  return c;
}

template <int Dim>
TimedRun<Dim>::TimedRun(std::unique_ptr<Engine<Dim>> engine, Configuration<Dim> start)
    : engine_(std::move(engine)), now_(std::move(start)) {}

template <int Dim>
Work TimedRun<Dim>::blocks(double min_seconds) {
  Work work;
  const double start_time = now_.time, start = processor_seconds();
  do {
    engine_->load(now_);
    engine_->advance(std::numeric_limits<double>::max(), work.counters);
    engine_->write(now_);
    work.seconds = processor_seconds() - start;
  } while (work.seconds < min_seconds);
  work.simulated_time = now_.time - start_time;
  return work;
}

template class TimedRun<2>;
template class TimedRun<3>;

std::size_t allocated_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace vitrel::bench
