#include "bench/surveys/whole_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "bench/baselines/method_engine.h"
#include "bench/surveys/thesis_run.h"
#include "core/state/check.h"
#include "core/state/configuration.h"
#include "edmd/brownian.h"

namespace vitrel::bench {
namespace {

constexpr double sample_interval = 0.1;
/// Between two samples some 25 collisions happen; a run that needs so many events stands still.
constexpr std::uint64_t max_events_per_sample = 100'000;

double energy(const Configuration2& c) {
  const Mechanics sums = mechanics(c);
  return sums.translational_energy + sums.rotational_energy;
}

// Runs the engine to `until`; false if it stands still.
bool advance(Engine2& engine, Configuration2& now, double until, RunCounters& counters) {
  const std::uint64_t events = counters.events;
  while (engine.advance(until, counters) == Engine2::Stop::block_end) {
    engine.write(now);
    if (counters.events - events > max_events_per_sample) return false;
    engine.load(now);
  }
  engine.write(now);
  return true;
}

}  // namespace

WholeRun thesis_scene_with(const Method& method, double duration, std::uint64_t seed,
                           const RunControl& control) {
  using Clock = std::chrono::steady_clock;
  Configuration2 now = on_lattice({});
  set_initial_velocities(now, seed, InitialVelocities::maxwell, Temperature::total);
  const double first_energy = energy(now);
  EngineOptions options;
  options.on_overlap = OnOverlap::correct;
  const auto engine = make_method_engine(method, options);
  RunCounters counters;
  WholeRun result{method.name, method.tolerance};
  Clock::duration running{};
  engine->load(now);
  for (int sample = 1; sample * sample_interval <= duration && !control.stop_requested();
       ++sample) {
    const auto start = Clock::now();
    result.stood_still = !advance(*engine, now, sample * sample_interval, counters);
    running += Clock::now() - start;
    result.energy_drift = std::max(result.energy_drift, std::abs(energy(now) / first_energy - 1));
    result.deepest_overlap =
        std::max(result.deepest_overlap, -exact_check(now).smallest_gap / now.shape[0].b);
    if (result.stood_still) break;
    result.simulated_time = now.time;
  }
  result.collisions = counters.collisions;
  result.correction_moves = counters.correction_moves;
  result.collisions_per_second =
      static_cast<double>(counters.collisions) / std::chrono::duration<double>(running).count();
  return result;
}

std::vector<Method> methods_for_whole_runs() {
  std::vector<Method> methods = collision_time_methods_by_tolerance();
  constexpr std::array able{"separating_axis", "slsqp", "slsqp_checked", "psi_root",
                            "perram_wertheim_root"};
  std::erase_if(methods,
                [&](const Method& method) { return !std::ranges::count(able, method.name); });
  return methods;
}

}  // namespace vitrel::bench
