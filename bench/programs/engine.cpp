// How fast is the engine, how does its cost grow with the number of particles, and what does each of
// its devices gain?
//
// Prints JSON. scripts/validate engine builds and runs this, compares with what is wanted, and
// writes the page, engine.md.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "bench/baselines/all_pairs.h"
#include "bench/baselines/engine_variants.h"
#include "bench/methods/method.h"
#include "bench/programs/parts.h"
#include "bench/programs/repeats.h"
#include "bench/surveys/engine_speed.h"
#include "core/io/json.h"
#include "core/neighbors/neighborhood.h"
#include "core/neighbors/pairs.h"
#include "edmd/brownian.h"
#include "edmd/instances/instances.h"
#include "edmd/run.h"

namespace vitrel::bench {
namespace {

/// How much is measured, and for how long.
struct Effort {
  int repeats = 5;
  double stretch = 1;  // seconds of a repeat, at least
  int disks = 4096, ellipses = 1024;
  int tile = 1000;  // particles
  int gas = 2000, large_gas = 100'000;
  std::vector<std::pair<int, int>> tilings = {{1, 1}, {5, 2}, {10, 10}, {40, 25}};
  std::vector<int> chart_sizes = {10, 30, 100, 300, 1000, 3000, 10000};
  int largest_all_pairs = 3000;  // its tables take 88 bytes for each pair
  int largest_slsqp = 1000;  // overlaps that it leaves can take thousands of slow events to mend
  double all_pairs_seconds = 8;
  int largest = 1'000'000;
};
const Effort quick{2, 0.01, 100, 64, 64, 200, 400, {{1, 1}, {2, 2}}, {10, 30}, 30, 30, 0.02};

/// A liquid that has also moved by event-driven dynamics.
Configuration2 relaxed(const FluidScene& scene, double seconds) {
  const Configuration2 start = fluid(scene);
  TimedRun run(make_engine(start, {}), start);
  run.blocks(seconds);
  return run.now();
}

// ---- collisions per second --------------------------------------------------------------------------

Json measure_speed(const Effort& effort) {
  Json rows = Json::array();
  const auto measure = [&](const FluidScene& scene) {
    say(fmt::format("speed: kappa = {}, phi = {}", scene.aspect_ratio, scene.packing_fraction));
    const Configuration2 start = relaxed(scene, effort.stretch);
    TimedRun run(make_engine(start, {}), start);
    Repeats repeats;
    for (int k = 0; k < effort.repeats; ++k) repeats.add(run.blocks(effort.stretch));
    Json row = scene_json(scene);
    row.update(repeats.json());
    row["reduced_pressure"] =
        1 + row["virial_rate"].get<double>() / (2.0 * scene.particles);  // kT = 1
    rows.push_back(row);
  };
  for (const double phi : {0.5, 0.7}) measure({effort.disks, 1, phi});
  for (const double kappa : {2., 6.})
    for (const double phi : {0.5, 0.7}) measure({effort.ellipses, kappa, phi});
  return rows;
}

// ---- cost against the number of particles -----------------------------------------------------------

Json measure_sizes(const Effort& effort) {
  Json rows = Json::array();
  for (const double kappa : {1., 2.}) {
    const FluidScene scene{effort.tile, kappa, 0.5};
    const Configuration2 tile = relaxed(scene, effort.stretch);
    for (const auto& [columns, vertical] : effort.tilings) {
      if (columns * vertical * effort.tile > effort.largest) continue;
      const Configuration2 start = tiled(tile, columns, vertical);
      say(fmt::format("size: kappa = {}, N = {}", kappa, start.size()));
      const std::size_t before = allocated_bytes();
      const bool peak_is_known = forget_peak();
      const std::size_t peak_before = peak_bytes();
      auto engine = make_engine(start, {});
      RunCounters counters;
      engine->load(start);
      engine->advance(start.time, counters);  // predicts
      const std::size_t allocated = allocated_bytes() - before;
      const std::size_t peak = peak_bytes() - peak_before;
      TimedRun run(std::move(engine), start);
      const auto n = static_cast<double>(start.size());
      constexpr double collisions_of_each = 5, max_stretches = 20;
      const double to_mix = 0.5 * collisions_of_each * n;
      run.parts(0, to_mix, to_mix);
      Repeats repeats;
      double spent = 0;
      for (int k = 0; k < effort.repeats && spent < max_stretches * effort.stretch; ++k) {
        repeats.add(run.blocks(effort.stretch));
        spent += repeats.last_seconds();
      }
      FluidScene whole = scene;
      whole.particles = static_cast<int>(start.size());
      Json row = scene_json(whole);
      row.update(repeats.json());
      row["bytes_per_particle"] = static_cast<double>(allocated) / n;
      if (peak_is_known) row["peak_bytes_per_particle"] = static_cast<double>(peak) / n;
      rows.push_back(row);
    }
  }
  return rows;
}

// ---- beside the program of the thesis ---------------------------------------------------------------

Json measure_all_pairs(const Effort& effort) {
  const std::vector<Method> methods = collision_time_methods();
  const Method& slsqp = *std::ranges::find(methods, "slsqp", &Method::name);
  EngineOptions correcting;
  correcting.on_overlap = OnOverlap::correct;
  Json rows = Json::array();
  for (const int n : effort.chart_sizes) {
    if (n > effort.largest) continue;
    say(fmt::format("all pairs: N = {}", n));
    const FluidScene scene{n, 2, 0.5};
    const Configuration2 start = relaxed(scene, 0.1 * effort.stretch);
    const auto add = [&](const char* program, const Work& work) {
      Repeats once;
      once.add(work);
      Json row = {{"program", program}};
      row.update(scene_json(scene));
      row.update(once.json());
      row["seconds_per_time"] = work.seconds / work.simulated_time;
      rows.push_back(row);
    };
    add("vitrel", TimedRun(make_engine(start, {}), start).blocks(effort.stretch));
    if (n > effort.largest_all_pairs) continue;
    constexpr double first_collisions = 4, enough_collisions = 2000;
    const auto add_all_pairs = [&](const char* program, const AllPairsOptions& options) {
      TimedRun run(make_all_pairs_engine(options), start);
      add(program, run.parts(effort.all_pairs_seconds, first_collisions, enough_collisions));
    };
    add_all_pairs("all_pairs", {{}, Asking::every_pair, nullptr});
    if (n > effort.largest_slsqp) continue;
    add_all_pairs("all_pairs_slsqp", {correcting, Asking::every_pair, &slsqp});
  }
  return rows;
}

// ---- Brownian dynamics ------------------------------------------------------------------------------

double wall_seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Json measure_brownian(const Effort& effort) {
  const FluidScene scene{effort.tile, 6, 0.72};
  say("Brownian dynamics");
  const Configuration2 start = relaxed(scene, effort.stretch);
  Json rows = Json::array();
  for (const double step : {0.01, 0.1})
    for (const int threads : {1, 2}) {
      DynamicsOptions options;
      options.engine.threads = threads;
      options.brownian = true;
      options.brownian_step = step;
      RunState2 state = begin_run(start, 0);
      RunPlan2 plan;
      const auto run_for = [&](double duration) {
        plan.end_time += duration;
        return wall_seconds_of([&] { run(state, options, plan, {}); });
      };
      const double trial = 20 * step;
      const double duration =
          std::max(trial, step * std::round(effort.stretch * trial / run_for(trial) / step));
      double best = 0;
      const RunCounters before = state.counters;
      for (int k = 0; k < effort.repeats; ++k) best = std::max(best, duration / run_for(duration));
      const auto steps = static_cast<double>(effort.repeats) * duration / step;
      Json row = scene_json(scene);
      row["brownian_step"] = step;
      row["threads"] = threads;
      row["time_per_second"] = best;
      row["collisions_per_step"] =
          static_cast<double>(state.counters.collisions - before.collisions) / steps;
      row["predictions_per_step"] =
          static_cast<double>(state.counters.predictions - before.predictions) / steps;
      rows.push_back(row);
    }
  return rows;
}

// ---- gases of disks and spheres: cells or lists -----------------------------------------------------

template <int Dim>
void measure_gas(const Effort& effort, int repeats, int particles, double packing_fraction,
                 Json& rows) {
  say(fmt::format("gas: {} dimensions, N = {}, phi = {}", Dim, particles, packing_fraction));
  const Configuration<Dim> start = gas<Dim>(particles, packing_fraction);
  const auto engine = [&](std::optional<NeighborSearch> neighbors) {
    EngineOptions options;
    options.neighbors = neighbors;
    return make_engine(start, options);
  };
  TimedRun<Dim> cells(engine(NeighborSearch::cells), start),
      lists(engine(NeighborSearch::lists), start);
  Repeats of_cells, of_lists;
  for (int k = 0; k < repeats; ++k) {
    of_cells.add(cells.blocks(0.5 * effort.stretch));
    of_lists.add(lists.blocks(0.5 * effort.stretch));
  }
  const bool chooses_cells =
      engine({})->description() == engine(NeighborSearch::cells)->description();
  rows.push_back({{"dimension", Dim},
                  {"particles", particles},
                  {"packing_fraction", packing_fraction},
                  {"chosen", chooses_cells ? "cells" : "lists"},
                  {"cells", of_cells.json()},
                  {"lists", of_lists.json()}});
}

Json measure_gases(const Effort& effort) {
  constexpr int large_repeats = 2;  // a block takes seconds
  Json rows = Json::array();
  for (const double phi : {0.001, 0.01, 0.1, 0.2, 0.3, 0.4, 0.5})
    measure_gas<2>(effort, effort.repeats, effort.gas, phi, rows);
  for (const double phi : {0.001, 0.01, 0.1, 0.2, 0.25, 0.3})
    measure_gas<3>(effort, effort.repeats, effort.gas, phi, rows);
  for (const double phi : {0.1, 0.2}) {
    if (effort.large_gas > effort.largest) break;
    measure_gas<2>(effort, large_repeats, effort.large_gas, phi, rows);
    measure_gas<3>(effort, large_repeats, effort.large_gas, phi, rows);
  }
  return rows;
}

// ---- what each device gains -------------------------------------------------------------------------

using MakeEngine = std::function<std::unique_ptr<Engine2>()>;

/// The engine as it is for the scene, and with another one, in alternation.
Json compare(const Effort& effort, const std::string& name, const FluidScene& scene,
             const MakeEngine& ours, const MakeEngine& other) {
  say("device: " + name);
  const Configuration2 start = relaxed(scene, 0.3 * effort.stretch);
  TimedRun with(ours(), start), without(other(), start);
  Repeats of_with, of_without;
  for (int k = 0; k < effort.repeats; ++k) {
    of_with.add(with.blocks(0.5 * effort.stretch));
    of_without.add(without.blocks(0.5 * effort.stretch));
  }
  Json row = {{"device", name}};
  row.update(scene_json(scene));
  row["with"] = of_with.json();
  row["without"] = of_without.json();
  return row;
}

/// How many neighbours there are at the margin that the engine chooses, and how many there would be
/// in lists shaped like the circumcircle.
Json neighbor_counts(const Configuration2& c) {
  constexpr double wanted = 7;
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < c.size(); ++i) poses.push_back(c.pose(i));
  const TypeIndex all_alike;
  Neighborhoods<Ellipse> lists(c.box, {c.shape.data(), 1}, all_alike, poses, wanted);
  const CellGrid<2> cells = make_cells(c);
  const double reach = 2 * (c.shape[0].a + lists.margin());
  std::size_t shaped = 0, round = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    shaped += lists.of(i).size();
    cells.for_each_near(c.position[i], reach,
                        [&](std::size_t, const Shift<2>&, const Vec2&) { ++round; });
    --round;  // itself
  }
  const auto n = static_cast<double>(c.size());
  return {{"margin", lists.margin()},
          {"shaped", static_cast<double>(shaped) / n},
          {"round", static_cast<double>(round) / n}};
}

/// Contacts are searched only if they can occur within the search window, for several windows in mean times between two
/// collisions of a particle.
Json lazy_refinement(const Effort& effort, const FluidScene& scene) {
  say("device: lazy refinement");
  struct Windowed {
    double window;
    TimedRun<2> run;
    Repeats repeats;
  };
  const Configuration2 start = relaxed(scene, 0.3 * effort.stretch);
  constexpr double eager = std::numeric_limits<double>::infinity();
  std::vector<Windowed> runs;
  for (const double window : {eager, 0.1, 0.3, 0.6, 1., 2.})
    runs.push_back({window, {make_engine_with_search_window(), start}, {}});
  for (int k = 0; k < effort.repeats; ++k)
    for (Windowed& of : runs) {
      set_search_window(of.window);
      of.repeats.add(of.run.blocks(0.3 * effort.stretch));
    }
  Json row = scene_json(scene);
  row["lazy"] = Json::array();
  for (const Windowed& of : runs)
    if (of.window == eager) {
      row["eager"] = of.repeats.json();
    } else {
      row["lazy"].push_back(of.repeats.json());
      row["lazy"].back()["search_window"] = of.window;
    }
  return row;
}

Json measure_devices(const Effort& effort) {
  const auto disks = [] { return make_disk_engine({}); };
  const auto ellipses = [] { return make_ellipse_engine({}); };
  const auto growing = [] { return make_growing_ellipse_engine({}); };
  Json rows = Json::array();
  rows.push_back(compare(effort, "disks", {effort.disks, 1, 0.5}, disks, ellipses));
  for (const double kappa : {2., 6.}) {
    const FluidScene scene{effort.ellipses, kappa, 0.7};
    rows.push_back(compare(effort, "constant_size", scene, ellipses, growing));
    rows.push_back(
        compare(effort, "contact_screen", scene, ellipses, make_engine_without_lower_bound));
    rows.push_back(compare(effort, "horizon", scene, ellipses, make_engine_without_horizon));
    rows.push_back(compare(effort, "shaped_lists", scene, ellipses, make_engine_with_round_lists));
    rows.back()["neighbors"] = neighbor_counts(relaxed(scene, 0));
  }
  return rows;
}

Json measure_lazy_refinement(const Effort& effort) {
  Json rows = Json::array();
  for (const double kappa : {2., 6.})
    rows.push_back(lazy_refinement(effort, {effort.ellipses, kappa, 0.7}));
  return rows;
}

// -----------------------------------------------------------------------------------------------------

const BenchParts<Effort> parts = {{"speed", measure_speed},         {"sizes", measure_sizes},
                                  {"all_pairs", measure_all_pairs}, {"brownian", measure_brownian},
                                  {"gases", measure_gases},         {"devices", measure_devices},
                                  {"lazy", measure_lazy_refinement}};

}  // namespace

int engine(const EngineSpeedOptions& options) {
  Effort effort = options.quick ? quick : Effort{};
  if (options.stretch > 0) effort.stretch = options.stretch;
  effort.largest = options.largest;
  return measure_parts(parts, effort, options.parts, 0.5 * effort.stretch);
}

}  // namespace vitrel::bench
