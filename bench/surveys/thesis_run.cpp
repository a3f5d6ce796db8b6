#include "bench/surveys/thesis_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bench/baselines/all_pairs.h"
#include "bench/methods/collision_case.h"
#include "bench/surveys/best_seconds.h"
#include "core/contact/perram_wertheim.h"
#include "core/state/check.h"
#include "edmd/brownian.h"
#include "mc/lattice.h"

namespace vitrel::bench {
namespace {

constexpr double sample_interval = 0.1;
/// A particle has about half a collision in a sample interval, so a run with this many events stands still.
constexpr std::uint64_t max_events_per_particle = 100;
constexpr double diagonal = 0.25 * std::numbers::pi;

double energy(const Configuration2& c) {
  const Mechanics sums = mechanics(c);
  return sums.translational_energy + sums.rotational_energy;
}

/// An engine that advances a configuration. Velocities are drawn anew every `brownian_step`, or never if it is 0.
class Driver {
 public:
  Driver(std::unique_ptr<Engine2> engine, const Configuration2& start, double brownian_step)
      : engine_(std::move(engine)), now_(start), brownian_step_(brownian_step) {
    engine_->load(now_, next_step());
  }

  /// Returns false if the engine stands still.
  bool advance(double until) {
    const std::uint64_t last = counters_.events + max_events_per_particle * now_.size();
    while (engine_->advance(until, counters_) == Engine2::Stop::block_end) {
      engine_->write(now_);
      if (counters_.events > last) return false;
      engine_->load(now_, next_step());
    }
    engine_->write(now_);
    return true;
  }

  double next_step() const {
    return brownian_step_ > 0 ? brownian_step_ * static_cast<double>(steps_ + 1) : Engine2::never;
  }
  /// Must be called at the time of the next step. `draw` receives the configuration and the number of the step.
  template <class Draw>
  void step(Draw draw) {
    ++steps_;
    draw(now_, steps_);
    engine_->set_velocities(now_, next_step(), counters_);
  }

  const Configuration2& now() const { return now_; }
  const RunCounters& counters() const { return counters_; }

 private:
  std::unique_ptr<Engine2> engine_;
  Configuration2 now_;
  double brownian_step_;
  std::uint64_t steps_ = 0;
  RunCounters counters_;
};

void note_overlaps(const Configuration2& now, ThesisRun& result) {
  const ExactCheck<2> check = exact_check(now);
  ++result.samples;
  if (check.clean()) return;
  ++result.samples_with_overlap;
  result.deepest_overlap = std::max(result.deepest_overlap, -check.smallest_gap / now.shape[0].b);
}

}  // namespace

double densest_square_lattice(const Ellipse& shape, double angle) {
  // The lattice constant is the largest at which a neighbour at (x, y) touches.
  double constant = 0;
  const int far = static_cast<int>(std::ceil(shape.aspect_ratio())) + 1;
  for (int x = 0; x <= far; ++x)
    for (int y = -far; y <= far; ++y) {
      if (x == 0 && y <= 0) continue;
      const Vec2 site(x, y);
      constant =
          std::max(constant, contact_distance(shape, angle, shape, angle, site) / norm(site));
    }
  return shape.volume() / (constant * constant);
}

Configuration2 on_lattice(const ThesisScene& scene) {
  Configuration2 c;
  c.resize(static_cast<std::size_t>(scene.particles));
  c.species_names = {"A"};
  std::ranges::fill(c.shape, of_unit_area(scene.aspect_ratio));
  const double length = std::sqrt(scene.particles * std::numbers::pi / scene.packing_fraction);
  c.box = PeriodicBox<2>(Vec2(length, length));
  const bool square_fits = densest_square_lattice(c.shape[0], diagonal) >= scene.packing_fraction;
  if (square_fits)
    place_on_lattice(c, {Arrangement::square, diagonal, false});
  else
    place_on_lattice(c, {Arrangement::triangular, 0, false});
  return c;
}

Configuration2 equilibrated(const ThesisScene& scene, double duration) {
  Configuration2 start = on_lattice(scene);
  set_initial_velocities(start, scene.seed, InitialVelocities::maxwell, Temperature::total);
  Driver driver(make_engine(start, {}), start, 0);
  driver.advance(duration);
  Configuration2 end = driver.now();
  end.time = 0;
  draw_velocities(end, scene.seed, Purpose::brownian_step, 0, Temperature::total);
  return end;
}

const char* name_of(Program program) {
  constexpr std::array names{"vitrel", "thesis", "improved"};
  return names[static_cast<std::size_t>(program)];
}

Json run_json(const ThesisRun& run) {
  return {{"simulated_time", run.simulated_time},
          {"collisions", run.counters.collisions},
          {"correction_moves", run.counters.correction_moves},
          {"energy_drift", run.energy_drift},
          {"samples", run.samples},
          {"samples_with_overlap", run.samples_with_overlap},
          {"deepest_overlap", run.deepest_overlap},
          {"stood_still", run.stood_still}};
}

std::unique_ptr<Engine2> make_program(Program program, const Configuration2& start) {
  if (program == Program::ours) return make_engine(start, {});
  const auto method = [](const char* name) {
    const std::vector<Method> methods = collision_time_methods();
    return *std::ranges::find(methods, name, &Method::name);
  };
  static const Method slsqp = method("slsqp"), checked = method("slsqp_checked");
  EngineOptions options;
  options.on_overlap = OnOverlap::correct;
  if (program == Program::thesis)
    return make_all_pairs_engine({options, Asking::every_pair, &slsqp});
  return make_all_pairs_engine({options, Asking::changed_pairs, &checked});
}

ThesisRun run_thesis(std::unique_ptr<Engine2> engine, const Configuration2& start,
                     const RunLimits& limits, const RunControl& control) {
  ThesisRun result;
  Driver driver(std::move(engine), start, limits.brownian_step);
  const double first_energy = energy(start);
  const auto draw = [&](Configuration2& now, std::uint64_t step) {
    draw_velocities(now, limits.seed, Purpose::brownian_step, step, Temperature::total);
  };
  for (int sample = 1; !control.stop_requested(); ++sample) {
    const double until = sample_interval * sample;
    if (until > limits.duration * (1 + 1e-12)) break;
    result.seconds += seconds_of([&] { result.stood_still = !driver.advance(until); });
    note_overlaps(driver.now(), result);
    if (result.stood_still) break;
    result.simulated_time = until;
    if (limits.brownian_step == 0)
      result.energy_drift =
          std::max(result.energy_drift, std::abs(energy(driver.now()) / first_energy - 1));
    if (result.seconds > limits.seconds) break;
    if (driver.next_step() < until + 0.5 * sample_interval)
      result.seconds += seconds_of([&] { driver.step(draw); });
  }
  result.counters = driver.counters();
  return result;
}

}  // namespace vitrel::bench
