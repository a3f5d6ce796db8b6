#include "workflow/run/run.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/io/h5md.h"
#include "core/io/json.h"
#include "core/state/check.h"
#include "core/state/typical_scales.h"
#include "workflow/configuration/hard_contacts.h"
#include "workflow/configuration/soft_particles.h"
#include "workflow/prepare/preparation_model.h"
#include "workflow/prepare/prepare.h"
#include "workflow/run/correlations_file.h"
#include "workflow/run/run_cost.h"
#include "workflow/run/run_start.h"
#include "workflow/storage/checkpoint_file.h"
#include "workflow/storage/trajectory_file.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

fs::path failed_state_path(const fs::path& output) {
  return output.string() + ".failed.h5";
}

/// Passes frames on to two observers, of which the second may be missing.
template <int Dim>
class Observers final : public Observer<Dim> {
 public:
  Observers(Observer<Dim>& first, Observer<Dim>* second) : first_(first), second_(second) {}
  void observe(const Frame<Dim>& frame) override {
    first_.observe(frame);
    if (second_) second_->observe(frame);
  }

 private:
  Observer<Dim>& first_;
  Observer<Dim>* second_;
};

/// The execution of one request.
template <int Dim>
class RunJob {
 public:
  RunJob(const RunRequest& request, const RunControl& control, const Log& log,
         Observer<Dim>* observer)
      : request_(request),
        control_(control),
        log_(log),
        observer_(observer),
        checkpoint_(checkpoint_path(request.output),
                    request.parameters.output.checkpoint_interval) {
    stored_.parameters = effective_parameters(request.parameters);
  }

  RunOutcome<Dim> run() {
    const bool continues = checkpoint_.exists();
    if (continues) {
      load();
    } else {
      refuse_foreign_output(request_.output);
      if (!begin()) return {};
    }
    const bool was_complete = stored_.complete;
    if (was_complete)
      log_line(log_, request_.output.string() + ": the run is complete already");
    else
      advance(continues);
    warn_of_exceptions();
    warn_of_long_steps();
    const std::size_t overlaps = overlaps_of_last_state();
    return {stored_.complete, was_complete, std::move(stored_.state), overlaps,
            stored_.wall_seconds};
  }

 private:
  bool is_soft() const { return request_.parameters.dynamics.contact.has_value(); }
  bool stops_on_overlap() const {
    return request_.parameters.dynamics.on_overlap == OnOverlap::stop;
  }

  void load() {
    const Checkpoint checkpoint = checkpoint_.load(log_);
    stored_ = stored_run<Dim>(request_, checkpoint);
    is_longer_ = stored_.parameters != checkpoint.parameters;
  }

  // Returns false if the preparation was stopped.
  bool begin() {
    Preparation<Dim> preparation = prepare<Dim>(preparation_request(request_), control_, log_);
    if (!preparation.complete) return false;
    request_.parameters = preparation.parameters;
    stored_.parameters = effective_parameters(request_.parameters);
    Configuration<Dim>& configuration = preparation.configuration;
    set_velocities(configuration, request_.parameters);
    stored_.state = begin_run(configuration, -request_.parameters.dynamics.equilibration);
    forget_correlations(request_.output);
    // The checkpoint comes before the trajectory, because a trajectory without a checkpoint is never taken for this
    // run's.
    save();
    forget_preparation(request_.output);
    return true;
  }

  /// Whether the dynamics conserve momentum and energy at every moment.
  bool is_conservative() const {
    const DynamicsParameters& dynamics = request_.parameters.dynamics;
    return dynamics.kind == DynamicsParameters::Kind::newtonian && !dynamics.driving &&
           !is_soft() && !is_dissipative(dynamics);
  }

  void make_correlator() {
    correlator_ = correlator(request_.parameters, stored_.state.configuration);
    if (correlator_ && !stored_.correlations.empty()) correlator_->restore(stored_.correlations);
  }

  void save() {
    if (correlator_) {
      stored_.correlations = correlator_->state();
      write_correlations(request_.output, request_.parameters, correlator_->correlations(),
                         correlator_->options().wave_numbers);
    }
    checkpoint_.save(to_checkpoint(stored_));
  }

  TrajectoryWriter open_trajectory(const std::string& model) const {
    const RunState<Dim>& state = stored_.state;
    if (state.next_sample > 0)
      return TrajectoryWriter::append_to(request_.output, state.next_sample);
    const StateStage* start = start_state(request_.parameters.stages);
    const std::string parent = start ? start->file.value_or("") : "";
    Provenance provenance = current_provenance(request_.command_line, stored_.parameters,
                                               request_.parameters.system.seed, parent);
    const std::string preparation = preparation_model(request_.parameters, state.configuration);
    provenance.model = preparation.empty() ? model : model + "; prepared by " + preparation;
    return TrajectoryWriter::create(request_.output, state.configuration, provenance,
                                    {.velocities = request_.parameters.output.velocities,
                                     .close_pairs = is_soft(),
                                     .single_precision = request_.parameters.output.precision ==
                                                         OutputParameters::Precision::single,
                                     .expected_frames = sample_times(request_.parameters).size(),
                                     .observables = run_observables(Dim, is_conservative()),
                                     .overwrite = true});
  }

  void advance(bool continues) {
    RunState<Dim>& state = stored_.state;
    if (continues)
      log_line(log_, "continuing at " + time_text(state.configuration.time, state.start_time));
    const DynamicsOptions options = dynamics();
    const std::string model = model_text(request_.parameters, state.configuration);
    log_line(log_, "run of " + model);
    TrajectoryWriter writer = open_trajectory(model);
    const std::vector<std::string> observables = writer.observable_names();
    TrajectoryObserver<Dim> file(
        writer, [&](const Frame<Dim>& frame) { return measure_run(frame, observables); });
    Observers<Dim> observers(file, observer_);
    make_correlator();
    if (is_longer_) begin_longer(writer);
    const WorkTimer timer(stored_.wall_seconds);
    RunPlan<Dim> plan{sample_times(request_.parameters), request_.parameters.dynamics.duration,
                      &observers, [&](const RunState<Dim>&) {
                        stored_.wall_seconds = timer.seconds();
                        if (!checkpoint_.is_due()) return;
                        // The frames must be on disk before a checkpoint counts them.
                        writer.synchronize();
                        save();
                      }};
    if (correlator_) plan.ticks = {correlator_->options().interval, &*correlator_};
    if (request_.parameters.dynamics.relaxation_times)
      plan.is_over = [this](double time) { return is_known(time); };
    const StageReport report = run_or_keep_failed_state(options, plan);
    stored_.wall_seconds = timer.seconds();
    stored_.complete = report.end == StageEnd::reached;
    writer.record_wall_seconds(stored_.wall_seconds);
    writer.synchronize();
    writer.close();
    save();
  }

  /// Whether the run has lasted as many relaxation times as it should.
  bool is_known(double time) const {
    const DynamicsParameters& p = request_.parameters.dynamics;
    if (!is_time_to_look(time, correlator_->options().interval, p.duration)) return false;
    const double relaxation = known_relaxation(correlator_->correlations().front(), Dim);
    if (!(time >= *p.relaxation_times * relaxation)) return false;
    log_line(log_,
             fmt::format("the run ends after {:g}, which is {:.3g} relaxation times of {:.4g}",
                         time, time / relaxation, relaxation));
    return true;
  }

  /// Saves a checkpoint that is not complete, so that the previous checkpoint lies before the end again, however
  /// short the rest of the run is.
  void begin_longer(TrajectoryWriter& writer) {
    writer.record_parameters(stored_.parameters);
    writer.synchronize();
    save();
  }

  DynamicsOptions dynamics() const {
    DynamicsOptions options = dynamics_options(request_.parameters);
    options.engine.threads = request_.threads;
    if (const auto& contact = request_.parameters.dynamics.contact) {
      options.engine.soft_contact =
          soft_contact(request_.parameters, stored_.state.configuration, request_.threads, log_);
      options.engine.early_release = contact->early_release;
    }
    return options;
  }

  StageReport run_or_keep_failed_state(const DynamicsOptions& options, const RunPlan<Dim>& plan) {
    try {
      return vitrel::run(stored_.state, options, plan, control_);
    } catch (const InvariantError& error) {
      keep_failed_state();
      throw InvariantError(fmt::format("{}; the state is in {}", error.what(),
                                       failed_state_path(request_.output).string()));
    }
  }

  void keep_failed_state() const {
    write_state(failed_state_path(request_.output), stored_.state.configuration,
                current_provenance(request_.command_line, stored_.parameters,
                                   request_.parameters.system.seed, request_.output.string()),
                true);
  }

  /// The summary counts contacts that did not follow their law. If there are many, the results do not represent that
  /// law.
  void warn_of_exceptions() const {
    constexpr double acceptable_share = 0.05;
    const RunCounters& c = stored_.state.counters;
    const auto warn = [&](double part, double whole, const char* what) {
      if (part > acceptable_share * whole)
        log_line(log_, fmt::format("warning: {:.0f} % {}", 100 * part / whole, what));
    };
    const auto collisions = static_cast<double>(c.collisions);
    warn(static_cast<double>(c.blocked_rotations), collisions,
         "of the collisions were those of hard particles, because neighbours blocked the rotation "
         "of the pair (blocked_rotations): the contacts are too long, or the system too dense, for "
         "event-driven dynamics");
    warn(static_cast<double>(c.early_releases), collisions,
         "of the collisions ended before their time, because a third particle hit "
         "(early_releases): the contacts are "
         "too long, or the system too dense, for event-driven dynamics");
    if (!is_soft())
      warn(c.spared, c.dissipated,
           "of the dissipated energy is what the contact-time model spared (spared_energy): "
           "dynamics.contact_duration is not well below the time between collisions");
  }

  void warn_of_long_steps() const {
    const DynamicsParameters& p = request_.parameters.dynamics;
    if (p.kind != DynamicsParameters::Kind::brownian) return;
    const std::string text =
        long_step_text(p.brownian_step, typical_time(stored_.state.configuration));
    if (!text.empty()) log_line(log_, "warning: " + text);
  }

  std::size_t overlaps_of_last_state() const {
    const std::size_t overlaps = exact_check(stored_.state.configuration).overlaps.size();
    if (overlaps == 0 || !stops_on_overlap()) return overlaps;
    keep_failed_state();
    throw InvariantError(fmt::format(
        "the last state has {} overlapping pair(s), which the run did not notice: a defect of the "
        "program; the state is in {}",
        overlaps, failed_state_path(request_.output).string()));
  }

  /// The request. Its species become those of the state from which the run starts.
  RunRequest request_;
  const RunControl& control_;
  const Log& log_;
  Observer<Dim>* observer_;  ///< of the caller; may be null
  CheckpointFile checkpoint_;
  RunCheckpoint<Dim> stored_;
  std::optional<MultipleTau<Dim>> correlator_;  ///< on the fly, if the parameters ask for it
  bool is_longer_ = false;  ///< whether the duration was increased since the last checkpoint
};

}  // namespace

int run_dimension(const RunRequest& request) {
  const fs::path checkpoint = checkpoint_path(request.output);
  if (checkpoint_exists(checkpoint)) return dimension_of(load_checkpoint(checkpoint).checkpoint);
  return prepared_dimension(preparation_request(request));
}

template <int Dim>
RunOutcome<Dim> run_simulation(const RunRequest& request, const RunControl& control, const Log& log,
                               Observer<Dim>* observer) {
  return RunJob<Dim>(request, control, log, observer).run();
}

template <int Dim>
Json run_summary(const RunRequest& request, const RunOutcome<Dim>& outcome) {
  const RunState<Dim>& state = outcome.state;
  const RunCounters& counters = state.counters;
  const TrajectoryReader trajectory(request.output);
  const DynamicsParameters& dynamics = request.parameters.dynamics;
  const CompressibilitySeries z =
      stored_compressibility(trajectory, observed_energies(trajectory),
                             rotation_count(state.configuration, contacts_of(dynamics)));
  const double simulated = state.configuration.time - state.start_time;
  const auto collisions = static_cast<double>(counters.collisions);
  Json summary = {
      {"output", request.output.string()},
      {"complete", outcome.complete},
      {"particles", state.configuration.size()},
      {"packing_fraction", packing_fraction(state.configuration)},
      {"model", trajectory.provenance().model},
      {"simulated_time", simulated},
      {"frames", trajectory.frames()},
      {"collisions", counters.collisions},
      {"events", counters.events},
      {"predictions_per_collision", static_cast<double>(counters.predictions) / collisions},
      {"searches_per_collision", static_cast<double>(counters.searches) / collisions},
      {"correction_moves", counters.correction_moves},
      {"energy_drift", state.energy_drift},
      {"largest_momentum", state.largest_momentum},
      {"compressibility_factor", z.mean.mean},
      {"compressibility_factor_error", z.mean.error},
      {"overlaps", outcome.overlaps},
      {"wall_seconds", outcome.wall_seconds},
      {"collisions_per_second", collisions / (outcome.wall_seconds - state.output_seconds)},
      {"collisions_per_second_with_output", collisions / outcome.wall_seconds}};
  if (dynamics.kind == DynamicsParameters::Kind::brownian)
    summary["brownian_step_in_sizes"] = dynamics.brownian_step / typical_time(state.configuration);
  if (is_dissipative(dynamics) || dynamics.contact)
    summary["dissipated_energy"] = counters.dissipated;
  if (dynamics.driving) summary["supplied_energy"] = counters.supplied;
  if (dynamics.contact_duration > 0 || dynamics.contact) {
    summary["short_flights"] = counters.short_flights;
    summary["spared_energy"] = counters.spared;
    summary["added_energy"] = counters.added;
  }
  if (dynamics.contact) {
    summary["blocked_rotations"] = counters.blocked_rotations;
    summary["early_releases"] = counters.early_releases;
    summary["blocked_rotations_per_collision"] =
        static_cast<double>(counters.blocked_rotations) / collisions;
    summary["early_releases_per_collision"] =
        static_cast<double>(counters.early_releases) / collisions;
    summary["integrated_contacts"] = counters.integrations;
  }
  if (request.parameters.output.correlations)
    summary["correlations"] = correlations_path(request.output).string();
  return summary;
}

template RunOutcome<2> run_simulation<2>(const RunRequest&, const RunControl&, const Log&,
                                         Observer<2>*);
template RunOutcome<3> run_simulation<3>(const RunRequest&, const RunControl&, const Log&,
                                         Observer<3>*);
template Json run_summary(const RunRequest&, const RunOutcome<2>&);
template Json run_summary(const RunRequest&, const RunOutcome<3>&);

}  // namespace vitrel
