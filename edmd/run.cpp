#include "edmd/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "edmd/brownian.h"
#include "edmd/time_text.h"

namespace vitrel {

namespace {

template <int Dim>
double total_energy(const Configuration<Dim>& configuration) {
  const auto sums = mechanics(configuration);
  return sums.translational_energy + sums.rotational_energy;
}

template <int Dim>
class EventDrivenRun {
 public:
  EventDrivenRun(RunState<Dim>& state, const DynamicsOptions& options, const RunPlan<Dim>& plan,
                 const RunControl& control)
      : state_(state),
        options_(options),
        plan_(plan),
        control_(control),
        engine_(make_engine(state.configuration, options.engine)),
        ticks_(plan.ticks.observer ? linear_times(plan.ticks.interval, plan.end_time)
                                   : SampleTimes()) {}

  StageReport run() {
    try {
      return run_blocks();
    } catch (const InvariantError&) {
      engine_->write(state_.configuration);
      throw;
    }
  }

 private:
  StageReport run_blocks() {
    while (true) {
      const double block_start = state_.configuration.time;
      engine_->load(state_.configuration, horizon());
      const bool finished = run_block();
      engine_->write(state_.configuration);
      record_conservation();
      if (!finished && !(state_.configuration.time > block_start))
        throw InvariantError("the simulation stands still at " + time_text(block_start) +
                             ": a block of events took no simulated time (" +
                             (are_soft(options_.engine)
                                  ? "too dense or too strongly damped for event-driven contacts?)"
                                  : "inelastic collapse? dynamics.contact_duration goes on from "
                                    "there)"));
      if (plan_.at_block_end && !finished) timed_output([&] { plan_.at_block_end(state_); });
      control_.report_progress(progress());
      if (finished) return {StageEnd::reached, "the end of the run was reached"};
      if (control_.stop_requested()) return {StageEnd::stopped, "stopped at the end of a block"};
    }
  }

  // Runs one block. Returns true if the end of the run was reached. A block also ends after many samples, ticks and
  // steps, however few events come between them, because stops and checkpoints wait for the end of a block.
  bool run_block() {
    constexpr int max_stops = 256;
    for (int stops = 0; stops < max_stops; ++stops) {
      const double stop = next_stop();
      if (engine_->advance(stop, state_.counters) == Engine<Dim>::Stop::block_end) return false;
      if (stop == next_sample_time()) observe(plan_.observer, state_.next_sample, stop);
      if (stop == next_tick_time()) {
        observe(plan_.ticks.observer, state_.next_tick, stop);
        if (stop > 0 && plan_.is_over && plan_.is_over(stop)) return true;
      }
      if (stop == next_step_time()) change_velocities();
      if (stop >= plan_.end_time && std::min(next_sample_time(), next_tick_time()) > plan_.end_time)
        return true;
    }
    return false;
  }

  double next_sample_time() const { return time_of(plan_.sample_times, state_.next_sample); }
  double next_tick_time() const { return time_of(ticks_, state_.next_tick); }
  static double time_of(const SampleTimes& times, std::uint64_t k) {
    return k < times.size() ? times[k] : std::numeric_limits<double>::infinity();
  }
  double next_step_time() const {
    const double interval = options_.brownian  ? options_.brownian_step
                            : options_.driving ? options_.driving->interval
                                               : std::numeric_limits<double>::infinity();
    return state_.start_time + interval * static_cast<double>(state_.velocity_steps + 1);
  }
  // The horizon of predictions is not the end of the run: the motion must not depend on the end, so that a run can be
  // made longer.
  double horizon() const { return next_step_time(); }
  double next_stop() const {
    return std::min({plan_.end_time, next_sample_time(), next_tick_time(), next_step_time()});
  }

  // Passes the frame to the observer, if any, and counts it.
  void observe(Observer<Dim>* observer, std::uint64_t& number, double time) {
    engine_->write(state_.configuration);
    state_.configuration.time = time;
    const Tally tally{state_.counters.collisions, state_.counters.virial,
                      state_.counters.helfand_moment};
    const Frame<Dim> frame{static_cast<std::int64_t>(number), state_.configuration, tally};
    if (observer) timed_output([&] { observer->observe(frame); });
    ++number;
  }

  void timed_output(auto&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    state_.output_seconds += spent.count();
  }

  // Takes a Brownian step, or kicks the particles.
  void change_velocities() {
    Configuration<Dim>& configuration = state_.configuration;
    const int threads = options_.engine.threads;
    engine_->write(configuration);
    record_conservation();
    ++state_.velocity_steps;
    if (options_.brownian) {
      configuration.releases.clear();  // they hold velocities from before the step
      draw_velocities(configuration, options_.seed, Purpose::brownian_step, state_.velocity_steps,
                      options_.temperature, contacts(options_.engine), threads);
    } else {
      const double before = total_energy(configuration);
      kick(configuration, *options_.driving, options_.seed, state_.velocity_steps, threads);
      state_.counters.supplied += total_energy(configuration) - before;
    }
    engine_->set_velocities(configuration, horizon(), state_.counters);
    state_.flight_energy = total_energy(configuration) + state_.counters.dissipated;
  }

  void record_conservation() {
    const double energy = total_energy(state_.configuration) + state_.counters.dissipated;
    const double drift = std::abs(energy - state_.flight_energy) / state_.flight_energy;
    state_.energy_drift = std::max(state_.energy_drift, drift);
    state_.largest_momentum =
        std::max(state_.largest_momentum, norm(mechanics(state_.configuration).momentum));
    require_little_added_energy();
  }

  void require_little_added_energy() const {
    constexpr double bound = 1e-5;
    const double share = state_.counters.added / state_.flight_energy;
    if (share > bound)
      throw InvariantError(
          "by " + time_text(state_.configuration.time) +
          " the contact-time model has added more than 1e-5 of the energy, to keep apart surfaces "
          "that touch again and again; use a longer dynamics.contact_duration, a coefficient of "
          "restitution closer to 1, or a shorter run");
  }

  /// Reports time before 0 as equilibration.
  Progress progress() const {
    const double time = state_.configuration.time, start = state_.start_time;
    const double whole = plan_.end_time - start;
    const double fraction = whole > 0 ? (time - start) / whole : 1;
    return time < 0 ? Progress{fraction, time - start, "equilibration"}
                    : Progress{fraction, time, "time"};
  }

  RunState<Dim>& state_;
  const DynamicsOptions& options_;
  const RunPlan<Dim>& plan_;
  const RunControl& control_;
  std::unique_ptr<Engine<Dim>> engine_;
  const SampleTimes ticks_;  ///< ticks of the whole run
};

}  // namespace

template <int Dim>
RunState<Dim> begin_run(const Configuration<Dim>& configuration, double start_time) {
  RunState<Dim> state;
  state.configuration = configuration;
  state.configuration.time = start_time;
  state.start_time = start_time;
  state.flight_energy = total_energy(configuration);
  state.largest_momentum = norm(mechanics(configuration).momentum);
  return state;
}

template <int Dim>
StageReport run(RunState<Dim>& state, const DynamicsOptions& options, const RunPlan<Dim>& plan,
                const RunControl& control) {
  return EventDrivenRun<Dim>(state, options, plan, control).run();
}

template RunState<2> begin_run(const Configuration<2>&, double);
template StageReport run(RunState<2>&, const DynamicsOptions&, const RunPlan<2>&,
                         const RunControl&);
template RunState<3> begin_run(const Configuration<3>&, double);
template StageReport run(RunState<3>&, const DynamicsOptions&, const RunPlan<3>&,
                         const RunControl&);

}  // namespace vitrel
