// How accurate and how fast are event-driven and force-based runs of soft spheres, and what do soft collisions cost?

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
#include "bench/studies/repeats.h"
#include "bench/studies/soft_contacts.h"
#include "bench/surveys/engine_speed.h"
#include "core/io/json.h"
#include "edmd/brownian.h"
#include "edmd/run.h"
#include "edmd/soft/linear_dashpot.h"
#include "edmd/soft/restitution_table.h"
#include "edmd/soft/soft_contact.h"
#include "edmd/soft/viscoelastic.h"

namespace vitrel::bench {
namespace {

struct Effort {
  Shift<3> sites = {20, 20, 25};  // of the crystal from which runs start
  double relaxation = 5;          // number of collisions of each particle
  Shift<3> few_sites = {10, 10, 10};
  std::vector<double> steps_per_contact = {10, 30, 100, 300, 1000};
  double timed = 1;  // seconds over which a run is repeated
  int repeats = 5;
  double stretch = 0.5;  // seconds that a repeat takes at least
};
const Effort quick{{5, 5, 5}, 1, {4, 4, 4}, {10}, 0.01, 2, 0.01};

Effort effort_of(const StudyContext& context) {
  return context.options.quick ? quick : Effort{};
}

// ---- the gas of the source's figure 7 -------------------------------------------------------------------

// Units are m, kg/m³ and m/s; the thermal speed is √(2 kT/m).
constexpr double radius = 0.1, density = 1140, thermal_speed = 2;
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

/// The approximate mean time between collisions of one particle (Boltzmann): 1/(√2 n π σ² ⟨v⟩).
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

/// A gas made from the crystal by collisions of hard spheres.
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

template <class Force>
RestitutionTable table_of(const Force& force, double tolerance = 1e-8) {
  constexpr ValueRange usual_speeds{1e-3, 25};  // in m/s
  constexpr double min_width = 0.02;
  return {form_of<Force>(),
          restitution_domain(force, std::span(&pair, 1), usual_speeds.low, usual_speeds.high),
          {tolerance, min_width},
          1};
}

template <class Force>
EngineOptions tabulated(const Force& force, double tolerance = 1e-8) {
  return soft(force, TabulatedRestitution(form_of<Force>(), table_of(force, tolerance)));
}

// ---- accuracy and time ------------------------------------------------------------------------------------

const Viscoelastic granular{usual_modulus, poissons_ratio, 4e-5};

/// The classical rule, which acts at once along the line of centres, with the coefficient of restitution of a head-on
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

/// A granular gas before and after one mean free time, with the accurate final state.
struct Race {
  Configuration3 start, exact;
  double duration, contact;  ///< in s; `contact` is that of a head-on contact at the thermal speed
};

Configuration3 clusterwise(const Race& race, double tolerance) {
  ClusterwiseRun<3, Viscoelastic> run(race.start, granular, tolerance, 0.05 * race.contact);
  run.advance(race.duration);
  return run.state();
}

Race race(const Effort& effort) {
  constexpr double collisions = 20, tolerance = 1e-14;
  const Configuration3 start = gas(effort.few_sites, dilute, collisions, 1);
  const ScaledImpact head_on = scaled_impact(granular, pair, thermal_speed, 0);
  const double contact =
      integrate_contact<Viscoelastic>(head_on).duration * granular.scales(thermal_speed, pair).time;
  Race race{start, {}, mean_free_time(start), contact};
  race.exact = clusterwise(race, tolerance);
  return race;
}

/// A row with the deviations of the particles that have collided, in radii.
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
  return {{"method", way},
          {"ns_per_second", 1e9 * seconds / race.duration},
          {"particles", errors.size()},
          {"median", quantile(0.5)},
          {"ninth_decile", quantile(0.9)},
          {"largest", errors.back()}};
}

/// Repeats the run from the same start, including its setup, and takes the best time.
Json event_driven(const Race& race, const char* name, const EngineOptions& options,
                  const Effort& effort) {
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
  const auto steps = static_cast<std::uint64_t>(race.duration / race.contact * steps_per_contact);
  const double began = processor_seconds();
  ForceBasedRun<3, Viscoelastic> run(race.start, granular);
  run.advance(race.duration, steps);
  Json row = result_json(race, "force_based", processor_seconds() - began, run.state());
  row["parameter"] = steps_per_contact;
  return row;
}

Json adaptive(const Race& race) {
  constexpr double tolerance = 1e-13;
  const double began = processor_seconds();
  const Configuration3 found = clusterwise(race, tolerance);
  return result_json(race, "clusterwise", processor_seconds() - began, found);
}

Json measure_accuracy(const StudyContext& context) {
  const Effort effort = effort_of(context);
  const Race all = race(effort);
  Json rows = {event_driven(all, "integration", integrated(granular), effort)};
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
    rows.push_back(event_driven(all, "tables", tabulated(granular, tolerance), effort));
    rows.back()["parameter"] = tolerance;
  }
  rows.push_back(event_driven(all, "classical",
                              soft(granular, ClassicalRestitution(table_of(granular))), effort));
  for (const double steps_per_contact : effort.steps_per_contact)
    rows.push_back(force_based(all, steps_per_contact));
  rows.push_back(adaptive(all));
  return rows;
}

// ---- collisions per second --------------------------------------------------------------------------------

Json measure_speed(const StudyContext& context) {
  const Effort effort = effort_of(context);
  const Viscoelastic force{usual_modulus, poissons_ratio};
  Json rows = Json::array();
  for (const double packing_fraction : {1e-3, 1e-2, 1e-1, 3e-1}) {
    const Configuration3 start = gas(effort.sites, packing_fraction, effort.relaxation, 1);
    const auto with = [&start](const EngineOptions& options) -> MakeEngine<3> {
      return [&start, options] { return make_engine(start, options); };
    };
    for (Json row : alternating_runs<3>(start,
                                        {{"hard", with({})},
                                         {"tables", with(tabulated(force))},
                                         {"integration", with(integrated(force))}},
                                        effort.repeats, effort.stretch)) {
      row["packing_fraction"] = packing_fraction;
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace

Study soft_contact_study() {
  std::vector<Part> parts = {
      {.name = "accuracy",
       .about = "A granular gas at η = 0.001 for one mean free time, from one state. The "
                "reference integrates Newton's equations cluster by cluster with adaptive steps "
                "(baselines/clusterwise_run.h), `clusterwise` with ten times its tolerance; "
                "`force_based` are velocity Verlet steps with neighbour lists. The parameter is "
                "the tolerance of tables, or the number of steps per contact. `classical` is the "
                "coefficient of restitution of a head-on impact. Errors are distances from the "
                "reference, in radii, of the particles that have collided.",
       .measure = measure_accuracy,
       .cases = {},
       .cost = {"ns_per_second", "time per simulated second", Shown::time},
       .error = {"median", "median error", Shown::error, "radii"},
       .others = {{"ninth_decile", "ninth decile", Shown::error}, {"largest", "", Shown::error}},
       .varied = "parameter"},
      {.name = "speed",
       .about = "Elastic spheres, beside hard spheres in the same engine, in turns from the same "
                "state; the best repetition.",
       .measure = measure_speed,
       .cases = {{"packing_fraction", "η"}},
       .cost = {"ns_per_collision", "time per collision", Shown::time},
       .others = {{"renewals", "renewals per collision"}}},
      restitution_part()};
  return {.name = "soft-contacts",
          .aliases = {{"soft-spheres", {"accuracy", "speed"}}, {"restitution", {"restitution"}}},
          .question = "Soft contacts: integrated, tabulated or hard?",
          .parts = parts,
          .settled = {"Haff's law: the late slopes of ln T against ln t of cooling granular gases "
                      "are −1.6811 ± 0.0012 for viscoelastic spheres (Haff: −5/3) and −1.9960 ± "
                      "0.0023 for the linear dashpot (−2) (docs/validation.md, tests/physics)."}};
}

}  // namespace vitrel::bench
