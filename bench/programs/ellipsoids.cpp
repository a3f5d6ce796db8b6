// How fast is the engine in three dimensions, and do its collisions add up to the right pressure?
//
// Prints JSON. scripts/validate ellipsoids builds and runs this and compares with Carnahan and Starling.

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bench/programs/parts.h"
#include "bench/programs/repeats.h"
#include "bench/surveys/engine_speed.h"
#include "core/error.h"
#include "core/io/json.h"
#include "edmd/brownian.h"
#include "edmd/growth.h"
#include "edmd/instances/instances.h"
#include "mc/insertion.h"

namespace vitrel::bench {
namespace {

struct Effort {
  int repeats = 5;
  double stretch = 2;  // seconds of a repeat, at least
  std::size_t spheres = 10'000, ellipsoids = 1'000;
};
const Effort quick{2, 0.01, 64, 64};

struct Scene {
  std::string name;
  Ellipsoid shape;
  double packing_fraction;
  std::size_t particles;
};

/// Inserted at random, grown to the packing fraction and mixed by collisions; velocities at kT = 1.
Configuration3 liquid(const Scene& scene, double seconds) {
  Configuration3 c;
  c.resize(scene.particles);
  c.species_names = {"A"};
  const double volume = scene.shape.volume() / Ellipsoid{}.volume();
  std::ranges::fill(c.shape, Ellipsoid{scene.shape.semi_axes / std::cbrt(volume)});
  insert_particles(c, {0.1}, 1, {});
  GrowthOptions options;
  options.growth_rate = 0.02;
  options.packing_fraction = scene.packing_fraction;
  GrowthState state;
  const StageReport report = grow(c, options, state, {});
  if (report.end != StageEnd::reached)
    throw InvariantError("no state to measure: " + report.reason);
  TimedRun run(make_engine(c, {}), c);
  run.blocks(seconds);
  c = run.now();
  draw_velocities(c, 1, Purpose::velocities, 0, Temperature::total);
  return c;
}

bool is_round(const Scene& scene) {
  return scene.shape.semi_axes.minCoeff() == scene.shape.semi_axes.maxCoeff();
}

/// Z = 1 + Σ J n·d/(3 N kT t); of spheres also from their rate of collisions, Z − 1 = Γ σ √π/6 in the
/// units of m = kT = 1, with Γ per particle.
Json measure(const Scene& scene, const Effort& effort, std::unique_ptr<Engine3> engine,
             const Configuration3& start) {
  TimedRun run(std::move(engine), start);
  Repeats repeats;
  for (int k = 0; k < effort.repeats; ++k) repeats.add(run.blocks(effort.stretch));
  Json row = repeats.json();
  const auto n = static_cast<double>(start.size());
  row["z_of_virial"] = 1 + row["virial_rate"].get<double>() / (3 * n);
  if (is_round(scene)) {
    const double per_particle = 2 * row["collision_rate"].get<double>() / n;
    row["z_of_rate"] = 1 + per_particle * 2 * std::sqrt(std::numbers::pi) / 6;
  }
  return row;
}

/// Spheres beside the same spheres as ellipsoids.
Json measure_speed(const Effort& effort) {
  const std::vector<Scene> scenes = {
      {"spheres", {}, 0.3, effort.spheres},
      {"spheres", {}, 0.49, effort.spheres},
      {"spheroids 2", {Vec3(2, 1, 1)}, 0.5, effort.ellipsoids},
      {"spheroids 1/2", {Vec3(2, 2, 1)}, 0.5, effort.ellipsoids},
      {"1.25 : 1 : 0.8", {Vec3(1.25, 1, 0.8)}, 0.5, effort.ellipsoids},
      {"spheroids 10", {Vec3(10, 1, 1)}, 0.2, effort.ellipsoids},
  };
  Json rows = Json::array();
  for (const Scene& scene : scenes) {
    say(fmt::format("speed: {}, phi = {}", scene.name, scene.packing_fraction));
    const Configuration3 start = liquid(scene, effort.stretch);
    Json row = {{"name", scene.name},
                {"particles", scene.particles},
                {"packing_fraction", scene.packing_fraction}};
    row.update(measure(scene, effort, make_engine(start, {}), start));
    if (is_round(scene))
      row["as_ellipsoids"] = measure(scene, effort, make_ellipsoid_engine({}), start);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

int ellipsoids(const PartsOptions& options) {
  const BenchParts<Effort> parts = {{"speed", measure_speed}};
  const Effort effort = options.quick ? quick : Effort{};
  return measure_parts(parts, effort, options.parts, effort.stretch);
}

}  // namespace vitrel::bench
