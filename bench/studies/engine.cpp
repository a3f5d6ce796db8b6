// How fast is the engine, how does its cost grow, and what does each of its devices gain?

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "bench/baselines/engine_variants.h"
#include "bench/studies/calendar.h"
#include "bench/studies/repeats.h"
#include "bench/surveys/engine_speed.h"
#include "core/error.h"
#include "edmd/brownian.h"
#include "edmd/growth.h"
#include "edmd/instances/instances.h"
#include "edmd/run.h"
#include "mc/insertion.h"

namespace vitrel::bench {
namespace {

/// How much is measured, and for how long.
struct Effort {
  int repeats = 5;
  double stretch = 1;  // seconds of a repeat, at least
  int disks = 4096, ellipses = 1024;
  std::size_t spheres = 10'000, ellipsoids = 1'000;
  int tile = 1000;  // particles
  int gas = 2000;
  std::vector<std::pair<int, int>> tilings = {{1, 1}, {5, 2}, {10, 10}, {40, 25}};
};

Effort effort_of(const StudyContext& context) {
  return context.options.quick ? Effort{2, 0.01, 100, 64, 64, 64, 64, 200, {{1, 1}, {2, 2}}}
                               : Effort{};
}

template <int Dim>
using MakeEngine = std::function<std::unique_ptr<Engine<Dim>>()>;
template <int Dim>
using MadeEngines = std::vector<std::pair<std::string, MakeEngine<Dim>>>;

/// Engines in turns from the same state, a row for each.
template <int Dim>
void add_rows(const Effort& effort, const Configuration<Dim>& start, const Json& about,
              const MadeEngines<Dim>& engines, Json& rows) {
  std::vector<TimedRun<Dim>> runs;
  for (const auto& [name, make] : engines) runs.emplace_back(make(), start);
  std::vector<Repeats> repeats(runs.size());
  for (int k = 0; k < effort.repeats; ++k)
    for (std::size_t n = 0; n < runs.size(); ++n) repeats[n].add(runs[n].blocks(effort.stretch));
  for (std::size_t n = 0; n < runs.size(); ++n) {
    Json row = {{"method", engines[n].first}};
    row.update(about);
    row["particles"] = start.size();
    row.update(repeats[n].json());
    row["z"] =
        1 + row["virial_rate"].get<double>() / (Dim * static_cast<double>(start.size()));  // kT = 1
    rows.push_back(row);
  }
}

/// A liquid that has also moved by event-driven dynamics.
Configuration2 relaxed(const FluidScene& scene, double seconds) {
  const Configuration2 start = fluid(scene);
  TimedRun run(make_engine(start, {}), start);
  run.blocks(seconds);
  return run.now();
}

/// Inserted at random, grown to the packing fraction and mixed by collisions; velocities at kT = 1.
Configuration3 liquid(const Ellipsoid& shape, std::size_t particles, double packing_fraction,
                      double seconds) {
  Configuration3 c;
  c.resize(particles);
  c.species_names = {"A"};
  const double volume = shape.volume() / Ellipsoid{}.volume();
  std::ranges::fill(c.shape, Ellipsoid{shape.semi_axes / std::cbrt(volume)});
  insert_particles(c, {0.1}, 1, {});
  GrowthOptions options;
  options.growth_rate = 0.02;
  options.packing_fraction = packing_fraction;
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

template <int Dim>
MakeEngine<Dim> chosen_for(const Configuration<Dim>& start, const EngineOptions& options = {}) {
  return [&start, options] { return make_engine(start, options); };
}

Json measure_speed(const StudyContext& context) {
  const Effort effort = effort_of(context);
  Json rows = Json::array();
  const auto add = [&](const char* shape, const FluidScene& scene) {
    const Configuration2 start = relaxed(scene, effort.stretch);
    MadeEngines<2> engines = {{"engine", chosen_for(start)}};
    if (scene.aspect_ratio == 1)
      engines.push_back({"as ellipses", [] { return make_ellipse_engine({}); }});
    add_rows<2>(effort, start, {{"shape", shape}, {"packing_fraction", scene.packing_fraction}},
                engines, rows);
  };
  const auto add_solids = [&](const char* shape, const Vec3& semi_axes, double phi) {
    const bool is_round = semi_axes.minCoeff() == semi_axes.maxCoeff();
    const Configuration3 start =
        liquid({semi_axes}, is_round ? effort.spheres : effort.ellipsoids, phi, effort.stretch);
    MadeEngines<3> engines = {{"engine", chosen_for(start)}};
    if (is_round) engines.push_back({"as ellipses", [] { return make_ellipsoid_engine({}); }});
    add_rows<3>(effort, start, {{"shape", shape}, {"packing_fraction", phi}}, engines, rows);
  };
  for (const double phi : {0.5, 0.7}) add("disks", {effort.disks, 1, phi});
  for (const double phi : {0.5, 0.7}) add("κ = 2", {effort.ellipses, 2, phi});
  for (const double phi : {0.5, 0.7}) add("κ = 6", {effort.ellipses, 6, phi});
  for (const double phi : {0.3, 0.49}) add_solids("spheres", {1, 1, 1}, phi);
  add_solids("spheroids 2", {2, 1, 1}, 0.5);
  add_solids("spheroids 1/2", {2, 2, 1}, 0.5);
  add_solids("1.25 : 1 : 0.8", {1.25, 1, 0.8}, 0.5);
  add_solids("spheroids 10", {10, 1, 1}, 0.2);
  return rows;
}

Json measure_sizes(const StudyContext& context) {
  const Effort effort = effort_of(context);
  Json rows = Json::array();
  for (const double kappa : {1., 2.}) {
    const Configuration2 tile = relaxed({effort.tile, kappa, 0.5}, effort.stretch);
    for (const auto& [columns, vertical] : effort.tilings) {
      const Configuration2 start = tiled(tile, columns, vertical);
      const std::size_t before = allocated_bytes();
      auto engine = make_engine(start, {});
      RunCounters counters;
      engine->load(start);
      engine->advance(start.time, counters);  // predicts
      const std::size_t allocated = allocated_bytes() - before;
      TimedRun run(std::move(engine), start);
      const auto n = static_cast<double>(start.size());
      constexpr double max_stretches = 20;
      run.blocks(0);  // mixes
      Repeats repeats;
      double spent = 0;
      for (int k = 0; k < effort.repeats && spent < max_stretches * effort.stretch; ++k) {
        repeats.add(run.blocks(effort.stretch));
        spent += repeats.last_seconds();
      }
      Json row = {{"method", "engine"}, {"aspect_ratio", kappa}, {"particles", start.size()}};
      row.update(repeats.json());
      row["bytes_per_particle"] = static_cast<double>(allocated) / n;
      rows.push_back(row);
    }
  }
  return rows;
}

double wall_seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Json measure_brownian(const StudyContext& context) {
  const Effort effort = effort_of(context);
  const Configuration2 start = relaxed({effort.tile, 6, 0.72}, effort.stretch);
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
      double best = std::numeric_limits<double>::infinity();
      for (int k = 0; k < effort.repeats; ++k) best = std::min(best, run_for(duration) / duration);
      rows.push_back({{"method", threads == 1 ? "one thread" : "two threads"},
                      {"brownian_step", step},
                      {"ns_per_time", 1e9 * best}});
    }
  return rows;
}

template <int Dim>
void add_gas(const Effort& effort, double packing_fraction, Json& rows) {
  const Configuration<Dim> start = gas<Dim>(effort.gas, packing_fraction);
  const auto with = [&](NeighborSearch neighbors) {
    EngineOptions options;
    options.neighbors = neighbors;
    return chosen_for(start, options);
  };
  const auto cells = with(NeighborSearch::cells);
  const bool chooses_cells = make_engine(start, {})->description() == cells()->description();
  add_rows<Dim>(effort, start,
                {{"dimension", Dim},
                 {"packing_fraction", packing_fraction},
                 {"chosen", chooses_cells ? "cells" : "lists"}},
                {{"cells", cells}, {"lists", with(NeighborSearch::lists)}}, rows);
}

Json measure_gases(const StudyContext& context) {
  const Effort effort = effort_of(context);
  Json rows = Json::array();
  for (const double phi : {0.001, 0.01, 0.1, 0.2, 0.3, 0.4, 0.5}) add_gas<2>(effort, phi, rows);
  for (const double phi : {0.001, 0.01, 0.1, 0.2, 0.25, 0.3}) add_gas<3>(effort, phi, rows);
  return rows;
}

Json measure_devices(const StudyContext& context) {
  const Effort effort = effort_of(context);
  Json rows = Json::array();
  for (const double kappa : {2., 6.}) {
    const Configuration2 start = relaxed({effort.ellipses, kappa, 0.7}, 0.3 * effort.stretch);
    add_rows<2>(effort, start, {{"aspect_ratio", kappa}},
                {{"engine", [] { return make_ellipse_engine({}); }},
                 {"growing at the rate 0", [] { return make_growing_ellipse_engine({}); }},
                 {"every pair searched", make_engine_without_lower_bound},
                 {"up to the own next event", make_engine_without_horizon},
                 {"lists like circumcircles", make_engine_with_round_lists}},
                rows);
  }
  return rows;
}

const Column time_per_collision = {"ns_per_collision", "time per collision", Shown::time};
const std::vector<Column> counts = {
    {"events"}, {"predictions"}, {"searches"}, {"steps"}, {"renewals"}};

std::vector<Column> counts_and(std::initializer_list<Column> more) {
  std::vector<Column> all = more;
  all.insert(all.end(), counts.begin(), counts.end());
  return all;
}

}  // namespace

Study engine_study() {
  return {
      .name = "engine",
      .aliases = {{"ellipsoids", {"speed"}}, {"solids", {"speed"}}, {"calendar", {"calendar"}}},
      .question =
          "How fast is the engine, how does its cost grow, and what does each of its devices gain?",
      .parts = {{.name = "speed",
                 .about = "Liquids, on one core, best of several repetitions; disks and spheres "
                          "also as general bodies. Counts are per collision, Z = βP/ρ is from the "
                          "collisional virial.",
                 .measure = measure_speed,
                 .cases = {{"shape"}, {"packing_fraction", "φ"}},
                 .cost = time_per_collision,
                 .others = counts_and({{"particles", "N"}, {"z", "Z"}})},
                {.name = "sizes",
                 .about = "Copies of a liquid at φ = 0.5, numbered at random.",
                 .measure = measure_sizes,
                 .cases = {{"aspect_ratio", "κ"}},
                 .cost = time_per_collision,
                 .others = {{"bytes_per_particle", "bytes per particle"}},
                 .varied = "particles"},
                {.name = "brownian",
                 .about = "Brownian dynamics of ellipses with κ = 6 at φ = 0.72, wall time.",
                 .measure = measure_brownian,
                 .cases = {{"brownian_step", "τ_B"}},
                 .cost = {"ns_per_time", "time per unit of simulated time", Shown::time}},
                {.name = "gases",
                 .about = "Disks and spheres with cells or with lists of neighbours; which the "
                          "engine chooses.",
                 .measure = measure_gases,
                 .cases = {{"dimension", "D"}, {"packing_fraction", "φ"}},
                 .cost = time_per_collision,
                 .others = counts_and({{"chosen"}})},
                {.name = "devices",
                 .about = "Ellipses at φ = 0.7 with one device of the engine taken out.",
                 .measure = measure_devices,
                 .cases = {{"aspect_ratio", "κ"}},
                 .cost = time_per_collision,
                 .others = counts},
                calendar_part()},
      .settled = {"Calendars: an 8-ary tournament and a sorted set took 1.4 to 17 times the time "
                  "of the queue from 10³ particles; at 100 the tournament was as fast (commit "
                  "85719d8). Linked lists instead of slots are a fifth cheaper while all data fit "
                  "into the caches, and take twice the time at 10⁶ particles.",
                  "Contacts that the screen excludes for a while are searched later: waiting for "
                  "0.6 to 1 mean free time makes a collision 3 to 8 % cheaper than an immediate "
                  "search; 0.1 costs up to 4 % (bench/engine.md of commit 08687eeb).",
                  "One prediction: Newton's method saves 28 %, series for sines and cosines 26 %, "
                  "and turning the axis to its predicted optimum 42 % of the time for random "
                  "pairs of κ = 2 (commit f976010)."}};
}

}  // namespace vitrel::bench
