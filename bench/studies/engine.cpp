// How fast is the engine, and how does its cost grow?

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "bench/methods/collision_case.h"
#include "bench/studies/calendar.h"
#include "bench/studies/repeats.h"
#include "bench/studies/study.h"
#include "bench/surveys/best_seconds.h"
#include "bench/surveys/engine_speed.h"
#include "edmd/instances/instances.h"
#include "edmd/run.h"

namespace vitrel::bench {
namespace {

/// The amount and the duration of the measurements.
struct Effort {
  int repeats = 5;
  double stretch = 1;  // seconds that a repeat takes at least
  int disks = 4096, ellipses = 1024;
  int spheres = 10'000, ellipsoids = 1'000;
  int tile = 1000;  // number of particles
  int gas = 2000;
  std::vector<std::pair<int, int>> tilings = {{1, 1}, {5, 2}, {10, 10}, {40, 25}};
};

Effort effort_of(const StudyContext& context) {
  return context.options.quick ? Effort{2, 0.01, 100, 64, 64, 64, 64, 200, {{1, 1}, {2, 2}}}
                               : Effort{};
}

/// Runs the engines in turns from the same state, and adds a row for each.
template <int Dim>
void add_rows(const Effort& effort, const Configuration<Dim>& start, const Json& about,
              const MadeEngines<Dim>& engines, Json& rows) {
  for (Json row : alternating_runs(start, engines, effort.repeats, effort.stretch)) {
    row.update(about);
    row["particles"] = start.size();
    row["z"] =
        1 + row["virial_rate"].get<double>() / (Dim * static_cast<double>(start.size()));  // kT = 1
    rows.push_back(row);
  }
}

/// A liquid that has also evolved by event-driven dynamics.
template <class Shape>
Configuration<Shape::dimension> relaxed(const Shape& shape, int particles, double packing_fraction,
                                        double seconds) {
  const auto start = liquid(shape, particles, packing_fraction);
  TimedRun run(make_engine(start, {}), start);
  run.blocks(seconds);
  return run.now();
}

template <int Dim>
MakeEngine<Dim> chosen_for(const Configuration<Dim>& start, const EngineOptions& options = {}) {
  return [&start, options] { return make_engine(start, options); };
}

Ellipsoid of_unit_volume(const Vec3& semi_axes) {
  return {semi_axes / std::cbrt(semi_axes.prod())};
}

/// The engines for a state. Round bodies also run as general ones.
template <int Dim>
MadeEngines<Dim> engines_for(const Configuration<Dim>& start) {
  MadeEngines<Dim> engines = {{"engine", chosen_for(start)}};
  const auto general = [] {
    if constexpr (Dim == 2)
      return make_ellipse_engine({});
    else
      return make_ellipsoid_engine({});
  };
  if (start.shape[0].is_round()) engines.push_back({"as ellipses", general});
  return engines;
}

Json measure_speed(const StudyContext& context) {
  const Effort effort = effort_of(context);
  Json rows = Json::array();
  const auto add = [&]<class Shape>(const char* name, const Shape& shape, int particles,
                                    double packing_fraction) {
    const auto start = relaxed(shape, particles, packing_fraction, effort.stretch);
    add_rows<Shape::dimension>(effort, start,
                               {{"shape", name}, {"packing_fraction", packing_fraction}},
                               engines_for(start), rows);
  };
  for (const double phi : {0.5, 0.7}) add("disks", of_unit_area(1), effort.disks, phi);
  for (const double phi : {0.5, 0.7}) add("κ = 2", of_unit_area(2), effort.ellipses, phi);
  for (const double phi : {0.5, 0.7}) add("κ = 6", of_unit_area(6), effort.ellipses, phi);
  for (const double phi : {0.3, 0.49}) add("spheres", Ellipsoid{}, effort.spheres, phi);
  const auto add_solids = [&](const char* name, const Vec3& semi_axes, double phi) {
    add(name, of_unit_volume(semi_axes), effort.ellipsoids, phi);
  };
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
    const Configuration2 tile = relaxed(of_unit_area(kappa), effort.tile, 0.5, effort.stretch);
    for (const auto& [columns, vertical] : effort.tilings) {
      const Configuration2 start = tiled(tile, columns, vertical);
      const std::size_t before = allocated_bytes();
      auto engine = make_engine(start, {});
      RunCounters counters;
      engine->load(start);
      engine->advance(start.time, counters);  // makes the first predictions
      const std::size_t allocated = allocated_bytes() - before;
      TimedRun run(std::move(engine), start);
      const auto n = static_cast<double>(start.size());
      constexpr double max_stretches = 20;
      run.blocks(0);  // mixes the copies of the tile
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

Json measure_brownian(const StudyContext& context) {
  const Effort effort = effort_of(context);
  const Configuration2 start = relaxed(of_unit_area(6), effort.tile, 0.72, effort.stretch);
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
        return seconds_of([&] { run(state, options, plan, {}); });
      };
      const double trial = 20 * step;
      const double duration =
          std::max(trial, step * std::round(effort.stretch * trial / run_for(trial) / step));
      const double best = best_seconds(effort.repeats, [&] { run_for(duration); });
      rows.push_back({{"method", threads == 1 ? "one thread" : "two threads"},
                      {"brownian_step", step},
                      {"ns_per_time", 1e9 * best / duration}});
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
      .question = "How fast is the engine, and how does its cost grow?",
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
                  "pairs of κ = 2 (commit f976010).",
                  "One device taken out, ellipses of κ = 2 and 6 at φ = 0.7: a search for every "
                  "pair takes 2.5 times as long, prediction up to the own next event instead of "
                  "that of the partner 1.3 times, and lists shaped like circumcircles 1.2 and 1.5 "
                  "times (commit 7e88c1c6)."}};
}

}  // namespace vitrel::bench
