// Dynamics of soft spheres: how accurate and how fast are event-driven and force-based runs, how does a granular gas
// cool, what do soft collisions cost, and what is conserved?
//
// Prints JSON. scripts/validate soft_spheres builds and runs this, compares with what is wanted, and writes
// its section of docs/validation.md.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bench/baselines/clusterwise_run.h"
#include "bench/baselines/force_based_run.h"
#include "bench/programs/parts.h"
#include "bench/programs/repeats.h"
#include "bench/surveys/engine_speed.h"
#include "bench/surveys/mean.h"
#include "core/io/json.h"
#include "core/random/stream.h"
#include "edmd/brownian.h"
#include "edmd/run.h"
#include "edmd/soft/linear_dashpot.h"
#include "edmd/soft/restitution_table.h"
#include "edmd/soft/soft_contact.h"
#include "edmd/soft/viscoelastic.h"

namespace vitrel::bench {
namespace {

struct Effort {
  Shift<3> sites = {20, 20, 25};  // of the crystal that runs start from
  double relaxation = 5;          // collisions of each particle
  Shift<3> few_sites = {10, 10, 10};
  std::vector<double> steps_per_contact = {10, 30, 100, 300, 1000};
  double timed = 1;  // seconds of a run that is repeated
  Shift<3> cooling_sites = {12, 12, 12};
  int cooling_runs = 4;
  double cooling_time = 3e5;  // s
  double long_run = 2000;     // collisions of each particle
  int clusters = 10;
  int repeats = 5;
  double stretch = 0.5;  // seconds of a repeat, at least
};
const Effort quick{{5, 5, 5}, 1, {4, 4, 4}, {10}, 0.01, {4, 4, 4}, 2, 3e2, 10, 2, 2, 0.01};

// ---- the gas of the source's figure 7 -------------------------------------------------------------------

constexpr double radius = 0.1, density = 1140, thermal_speed = 2;  // m, kg/m³, m/s; √(2 kT/m)
constexpr double poissons_ratio = 0.4, usual_modulus = 1e9, dilute = 1e-3;
const double mass = density * 4 * std::numbers::pi / 3 * radius * radius * radius;
const ContactPair pair = contact_pair(radius, mass, radius, mass);

Configuration3 crystal(const Shift<3>& sites, double packing_fraction, std::uint64_t seed) {
  Configuration3 c;
  const Ellipsoid sphere{Vec3::Constant(radius)};
  const double spacing = std::cbrt(sphere.volume() / packing_fraction);
  c.resize(static_cast<std::size_t>(sites.prod()));
  c.species_names = {"A"};
  c.box = PeriodicBox<3>(spacing * sites.cast<double>());
  std::ranges::fill(c.shape, sphere);
  std::ranges::fill(c.mass, mass);
  std::size_t i = 0;
  for (int x = 0; x < sites[0]; ++x)
    for (int y = 0; y < sites[1]; ++y)
      for (int z = 0; z < sites[2]; ++z)
        c.position[i++] = spacing * (Vec3(x, y, z) + Vec3::Constant(0.5)) - 0.5 * c.box.lengths();
  draw_velocities(c, seed, Purpose::velocities, 0, Temperature::total);
  for (Vec3& velocity : c.velocity) velocity *= thermal_speed * std::sqrt(mass / 2);
  return c;
}

/// Of one particle between collisions, roughly (Boltzmann): 1/(√2 n π σ² ⟨v⟩).
double mean_free_time(const Configuration3& c) {
  const double mean_speed = 2 * thermal_speed / std::sqrt(std::numbers::pi);
  const double cross_section = std::numbers::pi * 4 * radius * radius;
  return c.box.volume() /
         (std::sqrt(2) * static_cast<double>(c.size()) * cross_section * mean_speed);
}

void run_on(RunState3& state, const EngineOptions& options, double end_time) {
  RunPlan3 plan;
  plan.end_time = end_time;
  run(state, {options}, plan, {});
}

/// The crystal melted by hard collisions.
Configuration3 gas(const Shift<3>& sites, double packing_fraction, double collisions,
                   std::uint64_t seed) {
  RunState3 state = begin_run(crystal(sites, packing_fraction, seed), 0);
  run_on(state, {}, collisions * mean_free_time(state.configuration));
  state.configuration.time = 0;
  return state.configuration;
}

template <class Force, class Coefficients>
EngineOptions soft(const Force& force, Coefficients coefficients) {
  EngineOptions options;
  options.soft_contact =
      std::make_shared<SoftContactOf<Force, Coefficients>>(force, std::move(coefficients));
  return options;
}

template <class Force>
EngineOptions integrated(const Force& force) {
  return soft(force, IntegratedRestitution(form_of<Force>()));
}

constexpr ValueRange usual_speeds{1e-3, 25};  // m/s

template <class Force>
RestitutionTable table_of(const Force& force, const ValueRange& speeds = usual_speeds) {
  constexpr double tolerance = 1e-8, min_width = 0.02;
  return {form_of<Force>(),
          restitution_domain(force, std::span(&pair, 1), speeds.low, speeds.high),
          {tolerance, min_width},
          1};
}

template <class Force>
EngineOptions tabulated(const Force& force, const ValueRange& speeds = usual_speeds) {
  return soft(force, TabulatedRestitution(form_of<Force>(), table_of(force, speeds)));
}

// ---- accuracy and time ------------------------------------------------------------------------------------

const Viscoelastic granular{usual_modulus, poissons_ratio, 4e-5};

/// The classical rule: at once, along the line of centres, with the coefficient of restitution of a head-on
/// impact of this normal speed.
class ClassicalRestitution {
 public:
  explicit ClassicalRestitution(RestitutionTable table)
      : head_on_(form_of<Viscoelastic>(), std::move(table)) {}

  Restitution operator()(const ScaledImpact& impact) {
    const double least = impact.distance * std::exp(typical_obliqueness.low);
    return {1, 0, 0, head_on_({impact.distance, least, impact.damping}).rate};
  }
  std::uint64_t integrated() const { return head_on_.integrated(); }

 private:
  TabulatedRestitution head_on_;
};

/// A granular gas for one mean free time, and where its particles really are then.
struct Race {
  Configuration3 start, exact;
  double duration, contact;  ///< s; of a head-on contact at the thermal speed
};

Configuration3 clusterwise(const Race& race, double tolerance) {
  ClusterwiseRun<3, Viscoelastic> run(race.start, granular, tolerance, 0.05 * race.contact);
  run.advance(race.duration);
  return run.state();
}

Race race(const Effort& effort) {
  say("accuracy: reference");
  constexpr double collisions = 20, tolerance = 1e-14;
  const Configuration3 start = gas(effort.few_sites, dilute, collisions, 1);
  const ScaledImpact head_on = scaled_impact(granular, pair, thermal_speed, 0);
  const double contact =
      integrate_contact<Viscoelastic>(head_on).duration * granular.scales(thermal_speed, pair).time;
  Race race{start, {}, mean_free_time(start), contact};
  race.exact = clusterwise(race, tolerance);
  return race;
}

/// Of the particles that have collided, in radii.
Json result_json(const Race& race, const std::string& way, double seconds,
                 const Configuration3& found) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (race.exact.velocity[i] != race.start.velocity[i])
      errors.push_back((found.unwrapped(i) - race.exact.unwrapped(i)).norm() / radius);
  std::ranges::sort(errors);
  const auto quantile = [&](double share) {
    return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
  };
  return {{"way", way},
          {"seconds", seconds},
          {"particles", errors.size()},
          {"median", quantile(0.5)},
          {"ninth_decile", quantile(0.9)},
          {"largest", errors.back()}};
}

/// Again and again from the same start, with everything that takes; the best time.
Json event_driven(const Race& race, const char* name, const EngineOptions& options,
                  const Effort& effort) {
  say(fmt::format("accuracy: {}", name));
  constexpr int runs = 10;
  RunState3 state;
  double best = std::numeric_limits<double>::infinity();
  for (const double begin = processor_seconds(); processor_seconds() - begin < effort.timed;) {
    const double before = processor_seconds();
    for (int k = 0; k < runs; ++k) {
      state = begin_run(race.start, 0);
      run_on(state, options, race.duration);
    }
    best = std::min(best, (processor_seconds() - before) / runs);
  }
  Json row = result_json(race, name, best, state.configuration);
  row["collisions"] = state.counters.collisions;
  row["blocked_rotations"] = state.counters.blocked_rotations;
  row["early_releases"] = state.counters.early_releases;
  return row;
}

Json force_based(const Race& race, double steps_per_contact) {
  say(fmt::format("accuracy: force-based, {} steps per contact", steps_per_contact));
  const auto steps = static_cast<std::uint64_t>(race.duration / race.contact * steps_per_contact);
  const double began = processor_seconds();
  ForceBasedRun<3, Viscoelastic> run(race.start, granular);
  run.advance(race.duration, steps);
  Json row = result_json(race, "force-based", processor_seconds() - began, run.state());
  row["steps_per_contact"] = steps_per_contact;
  return row;
}

Json adaptive(const Race& race) {
  say("accuracy: clusterwise");
  constexpr double tolerance = 1e-13;
  const double began = processor_seconds();
  const Configuration3 found = clusterwise(race, tolerance);
  return result_json(race, "clusterwise", processor_seconds() - began, found);
}

Json measure_accuracy(const Effort& effort) {
  const Race all = race(effort);
  const double began = processor_seconds();
  const RestitutionTable table = table_of(granular);
  const Json built = {{"seconds", processor_seconds() - began},
                      {"megabytes", 1e-6 * static_cast<double>(table.bytes())}};
  const EngineOptions tables = soft(granular, TabulatedRestitution(form_of<Viscoelastic>(), table));
  Json rows = {event_driven(all, "tables", tables, effort),
               event_driven(all, "integration", integrated(granular), effort),
               event_driven(all, "classical", soft(granular, ClassicalRestitution(table)), effort)};
  for (const double steps_per_contact : effort.steps_per_contact)
    rows.push_back(force_based(all, steps_per_contact));
  rows.push_back(adaptive(all));
  return {{"particles", all.start.size()},
          {"packing_fraction", dilute},
          {"duration", all.duration},
          {"contact", all.contact},
          {"table", built},
          {"rows", rows}};
}

// ---- cooling ------------------------------------------------------------------------------------------------

class Thermometer : public Observer<3> {
 public:
  void observe(const Frame<3>& frame) override {
    temperatures.push_back(mechanics(frame.configuration).translational_energy /
                           (1.5 * static_cast<double>(frame.configuration.size())));
  }

  std::vector<double> temperatures;  ///< J
};

template <class Force>
Json cooling(const Force& force, const Effort& effort) {
  constexpr double packing_fraction = 0.01, first = 0.1, per_decade = 10;
  constexpr ValueRange speeds{1e-6, 25};
  RunPlan3 plan;
  for (int k = 0; plan.end_time < effort.cooling_time; ++k) {
    plan.end_time = first * std::pow(10, k / per_decade);
    plan.sample_times.push_back(plan.end_time);
  }
  const EngineOptions options = tabulated(force, speeds);
  Json runs = Json::array();
  std::uint64_t collisions = 0;
  for (int k = 1; k <= effort.cooling_runs; ++k) {
    say(fmt::format("cooling: {}, run {}", Force::name, k));
    RunState3 state =
        begin_run(gas(effort.cooling_sites, packing_fraction, effort.relaxation, k), 0);
    Thermometer thermometer;
    plan.observer = &thermometer;
    run(state, {options}, plan, {});
    runs.push_back(thermometer.temperatures);
    collisions += state.counters.collisions;
  }
  const double restitution =
      -integrate_contact<Force>(scaled_impact(force, pair, thermal_speed, 0)).rate;
  return {{"force", Force::name},
          {"particles", effort.cooling_sites.prod()},
          {"packing_fraction", packing_fraction},
          {"restitution", restitution},
          {"collisions", collisions},
          {"times", plan.sample_times},
          {"temperatures", runs}};
}

Json measure_cooling(const Effort& effort) {
  return Json::array({cooling(granular, effort), cooling(LinearDashpot{1e7, 327}, effort)});
}

// ---- collisions per second --------------------------------------------------------------------------------

Json measure_speed(const Effort& effort) {
  const Viscoelastic force{usual_modulus, poissons_ratio};
  const std::vector<std::pair<const char*, EngineOptions>> ways = {
      {"hard", {}}, {"tables", tabulated(force)}, {"integration", integrated(force)}};
  Json rows = Json::array();
  for (const double packing_fraction : {1e-3, 1e-2, 1e-1, 3e-1}) {
    say(fmt::format("speed: eta = {}", packing_fraction));
    const Configuration3 start = gas(effort.sites, packing_fraction, effort.relaxation, 1);
    std::vector<TimedRun<3>> runs;
    for (const auto& [name, options] : ways) runs.emplace_back(make_engine(start, options), start);
    std::vector<Repeats> repeats(ways.size());
    for (int k = 0; k < effort.repeats; ++k)
      for (std::size_t way = 0; way < ways.size(); ++way)
        repeats[way].add(runs[way].blocks(effort.stretch));
    Json row = {{"particles", start.size()}, {"packing_fraction", packing_fraction}};
    for (std::size_t way = 0; way < ways.size(); ++way) row[ways[way].first] = repeats[way].json();
    rows.push_back(row);
  }
  return rows;
}

// ---- conservation -----------------------------------------------------------------------------------------

double momentum_scale(const Configuration3& c) {
  double sum = 0;
  for (std::size_t i = 0; i < c.size(); ++i) sum += c.mass[i] * c.velocity[i].norm();
  return sum;
}

/// A long run in a periodic box.
template <class Force>
Json conservation_in(const Force& force, const char* name, const Effort& effort) {
  say(fmt::format("conservation: {}", name));
  constexpr double packing_fraction = 0.01;
  const Configuration3 start = gas(effort.few_sites, packing_fraction, effort.relaxation, 1);
  RunState3 state = begin_run(start, 0);
  run_on(state, tabulated(force), effort.long_run * mean_free_time(start));
  return {{"gas", name},
          {"collisions", state.counters.collisions},
          {"blocked_rotations", state.counters.blocked_rotations},
          {"early_releases", state.counters.early_releases},
          {"momentum", state.largest_momentum / momentum_scale(start)},
          {"energy", state.energy_drift}};
}

/// Σ m r × v; the unwrapped positions are continuous.
Vec3 angular_momentum(const Configuration3& c) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < c.size(); ++i) sum += c.mass[i] * c.unwrapped(i).cross(c.velocity[i]);
  return sum;
}

double angular_momentum_scale(const Configuration3& c) {
  double sum = 0;
  for (std::size_t i = 0; i < c.size(); ++i)
    sum += c.mass[i] * c.unwrapped(i).cross(c.velocity[i]).norm();
  return sum;
}

/// A hot cluster that flies apart in empty space.
Json conservation_of_clusters(EarlyRelease early_release, const Effort& effort) {
  constexpr double packing_fraction = 0.3, duration = 3, room = 100;
  EngineOptions options = tabulated(Viscoelastic{usual_modulus, poissons_ratio});
  options.early_release = early_release;
  RunCounters sum;
  std::vector<double> momentum, energy, lost;
  for (int k = 1; k <= effort.clusters; ++k) {
    Configuration3 start = crystal(effort.few_sites, packing_fraction, k);
    start.box = PeriodicBox<3>(Vec3::Constant(room));
    RunState3 state = begin_run(start, 0);
    run_on(state, options, duration);
    const Configuration3& end = state.configuration;
    momentum.push_back((mechanics(end).momentum - mechanics(start).momentum).norm() /
                       momentum_scale(start));
    energy.push_back(state.energy_drift);
    lost.push_back((angular_momentum(end) - angular_momentum(start)).norm() /
                   angular_momentum_scale(start));
    sum.collisions += state.counters.collisions;
    sum.blocked_rotations += state.counters.blocked_rotations;
    sum.early_releases += state.counters.early_releases;
  }
  const Mean mean = mean_of(lost);
  return {{"early_release", early_release == EarlyRelease::alone ? "alone" : "together"},
          {"clusters", effort.clusters},
          {"particles", effort.few_sites.prod()},
          {"collisions", sum.collisions},
          {"blocked_rotations", sum.blocked_rotations},
          {"early_releases", sum.early_releases},
          {"momentum", std::ranges::max(momentum)},
          {"energy", std::ranges::max(energy)},
          {"angular_momentum", {{"mean", mean.value}, {"error", mean.error}}},
          {"largest_angular_momentum", std::ranges::max(lost)}};
}

Json measure_conservation(const Effort& effort) {
  const Viscoelastic elastic{usual_modulus, poissons_ratio};
  return {{"gases", Json::array({conservation_in(elastic, "elastic", effort),
                                 conservation_in(granular, "granular", effort)})},
          {"clusters", Json::array({conservation_of_clusters(EarlyRelease::alone, effort),
                                    conservation_of_clusters(EarlyRelease::together, effort)})}};
}

}  // namespace

int soft_spheres(const PartsOptions& options) {
  const BenchParts<Effort> parts = {{"accuracy", measure_accuracy},
                                    {"cooling", measure_cooling},
                                    {"speed", measure_speed},
                                    {"conservation", measure_conservation}};
  const Effort effort = options.quick ? quick : Effort{};
  return measure_parts(parts, effort, options.parts, effort.stretch);
}

}  // namespace vitrel::bench
