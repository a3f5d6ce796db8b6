#include "workflow/run/run_start.h"

#include <fmt/format.h>

#include <optional>

#include "core/error.h"
#include "core/io/h5md.h"
#include "workflow/configuration/hard_contacts.h"
#include "workflow/configuration/start_state.h"
#include "workflow/storage/checkpoint_file.h"
#include "workflow/storage/checkpoint_items.h"
#include "workflow/storage/state_items.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

void refuse_changes(const Parameters& parameters, const std::string& begun_with,
                    const fs::path& output) {
  if (const auto change = forbidden_change(begun_with, effective_parameters(parameters), Work::run))
    throw UserError(
        fmt::format("{}: the run was begun with {} = {}, but now it is {}; continue it "
                    "with its own parameters, or choose another output",
                    output.string(), change->key, change->first, change->second));
}

/// Says why the file cannot be the trajectory of the run; no value if it can.
template <int Dim>
std::optional<std::string> difference(const TrajectoryReader& trajectory,
                                      const RunCheckpoint<Dim>& run, const Parameters& recorded) {
  if (trajectory.dimension() != Dim) return "is of another dimension";
  // Versions differ in the parameters that they record, so effective parameters are compared.
  const Parameters written =
      recorded_parameters(trajectory.provenance().parameters, trajectory.path().string());
  if (const auto change = forbidden_change(effective_parameters(written),
                                           effective_parameters(recorded), Work::run))
    return fmt::format("was written with {} = {}, not {}", change->key, change->first,
                       change->second);
  const std::uint64_t counted = run.state.next_sample;
  if (trajectory.frames() < counted)
    return fmt::format("has {} frames instead of {}", trajectory.frames(), counted);
  if (counted == 0) return std::nullopt;
  const SampleTimes expected_times = sample_times(recorded);
  if (counted > expected_times.size())
    return fmt::format("belongs to a run of {} frames", expected_times.size());
  const double time = trajectory.times()[counted - 1];
  const double expected = expected_times[counted - 1];
  if (time != expected)
    return fmt::format("has frame {} at time {}, not {}", counted - 1, time, expected);
  if (!same_particles(trajectory.read<Dim>(counted - 1), run.state.configuration))
    return "has other particles";
  return std::nullopt;
}

/// The trajectory must exist and hold the frames that the checkpoint counts, unless it counts none. `recorded` are
/// the parameters of the run.
template <int Dim>
void require_trajectory(const RunCheckpoint<Dim>& run, const Parameters& recorded,
                        const fs::path& output) {
  const auto refusal = [&](const std::string& why) {
    return FileError(fmt::format(
        "{}: {}, but {} is there, the checkpoint of the run that wrote {} frame(s) to it; restore "
        "the file, delete the checkpoint (and its .previous, if there) to start anew, or choose "
        "another output",
        output.string(), why, checkpoint_path(output).string(), run.state.next_sample));
  };
  if (fs::exists(output)) {
    if (const auto why = difference(TrajectoryReader(output), run, recorded)) throw refusal(*why);
  } else if (run.state.next_sample > 0) {
    throw refusal("is missing");
  }
}

void each_item(auto& run, auto&& visit) {
  auto& state = run.state;
  each_item_of_counters(state.counters, visit);
  visit("start_time", state.start_time);
  visit("flight_energy", state.flight_energy);
  visit("energy_drift", state.energy_drift);
  visit("largest_momentum", state.largest_momentum);
  visit("wall_seconds", run.wall_seconds);
  visit.if_recorded("output_seconds", state.output_seconds);
  visit("brownian_steps", state.velocity_steps);
  visit("next_sample", state.next_sample);
  visit("next_tick", state.next_tick);
  visit("correlations", run.correlations);
  visit("complete", run.complete);
}

/// Throws FileError, naming `file`, if a number is missing or if the checkpoint is of the other dimension.
template <int Dim>
RunCheckpoint<Dim> run_from_checkpoint(const Checkpoint& checkpoint,
                                       const std::filesystem::path& file) {
  const auto* configuration = std::get_if<Configuration<Dim>>(&checkpoint.configuration);
  if (!configuration)
    throw FileError(fmt::format("{}: is not of a run in {} dimensions", file.string(), Dim));
  RunCheckpoint<Dim> run;
  run.state.configuration = *configuration;
  run.parameters = checkpoint.parameters;
  each_item(run, ItemReader(checkpoint, file));
  return run;
}

/// Returns the checkpoint before the last one of a complete run. The last one is at the end, where a longer run would
/// not have stopped, so continuing from there would change the rounding.
template <int Dim>
RunCheckpoint<Dim> before_the_end(const fs::path& checkpoint) {
  const auto refusal = [&](const std::string& why) {
    return FileError(
        fmt::format("{}.previous: {}; a complete run is made longer from there, so "
                    "start it anew with its whole duration",
                    checkpoint.string(), why));
  };
  try {
    RunCheckpoint<Dim> run =
        run_from_checkpoint<Dim>(load_previous_checkpoint(checkpoint), checkpoint);
    if (!run.complete) return run;
  } catch (const FileError& error) {
    throw refusal(error.what());
  }
  throw refusal("is of the end of the run, too");
}

}  // namespace

fs::path checkpoint_path(const fs::path& output) {
  return output.string() + ".checkpoint";
}

template <int Dim>
RunCheckpoint<Dim> stored_run(RunRequest& request, const Checkpoint& checkpoint) {
  const fs::path file = checkpoint_path(request.output);
  const auto* state = std::get_if<Configuration<Dim>>(&checkpoint.configuration);
  // Defaults differ between versions; this restores those of the version that began the run.
  const Parameters recorded = recorded_parameters(checkpoint.parameters, file.string());
  if (start_state(request.parameters.stages) && state) {
    take_system(request.parameters, *state, file.string(), checkpoint.parameters);
    // Earlier versions recorded the stages of the parameter file even though the run did not use them.
    if (!start_state(recorded.stages)) request.parameters.stages = recorded.stages;
  }
  request.parameters = continued(request.parameters, recorded);
  refuse_changes(request.parameters, checkpoint.parameters, request.output);
  RunCheckpoint<Dim> run = run_from_checkpoint<Dim>(checkpoint, file);
  require_trajectory(run, recorded, request.output);
  const bool is_longer = request.parameters.dynamics.duration > recorded.dynamics.duration;
  if (run.complete && is_longer) run = before_the_end<Dim>(file);
  if (is_longer) run.parameters = effective_parameters(request.parameters);
  return run;
}

PrepareRequest preparation_request(const RunRequest& request) {
  return {.parameters = request.parameters,
          .output = request.output,
          .command_line = request.command_line,
          .threads = request.threads,
          .overlaps_allowed = request.parameters.dynamics.on_overlap == OnOverlap::correct};
}

void refuse_foreign_output(const fs::path& output) {
  if (!fs::exists(output)) return;
  if (fs::is_symlink(output))
    throw UserError(fmt::format("{}: is a link to {}, which a run is continued by; give that name",
                                output.string(), fs::read_symlink(output).string()));
  throw UserError(output.string() +
                  ": exists, but has no checkpoint beside it, so it cannot be continued; choose "
                  "another output, or delete it");
}

template <int Dim>
void set_velocities(Configuration<Dim>& configuration, const Parameters& parameters) {
  const DynamicsParameters& dynamics = parameters.dynamics;
  set_initial_velocities(configuration, parameters.system.seed, dynamics.initial_velocities,
                         dynamics.temperature, initial_energies(parameters), contacts_of(dynamics));
  const Mechanics<Dim> sums = mechanics(configuration);
  if (!(sums.translational_energy + sums.rotational_energy > 0))
    throw UserError(
        "dynamics.initial_velocities = \"keep\", but the state to start from is at rest; "
        "use \"maxwell\", or start (--from) from a run with velocities");
}

// The run equilibrates before time 0.
std::string time_text(double time, double start) {
  return time < 0 ? fmt::format("time {:.6g} of {:.6g} of the equilibration", time - start, -start)
                  : fmt::format("time {:.6g}", time + 0.);  // + 0. turns −0 into 0
}

template <int Dim>
Checkpoint to_checkpoint(const RunCheckpoint<Dim>& run) {
  Checkpoint checkpoint;
  checkpoint.configuration = run.state.configuration;
  checkpoint.parameters = run.parameters;
  each_item(run, ItemWriter(checkpoint));
  return checkpoint;
}

template RunCheckpoint<2> stored_run(RunRequest&, const Checkpoint&);
template RunCheckpoint<3> stored_run(RunRequest&, const Checkpoint&);
template void set_velocities(Configuration2&, const Parameters&);
template void set_velocities(Configuration3&, const Parameters&);
template Checkpoint to_checkpoint(const RunCheckpoint<2>&);
template Checkpoint to_checkpoint(const RunCheckpoint<3>&);

}  // namespace vitrel
