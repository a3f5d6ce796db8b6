#include "workflow/run/run_checkpoint.h"

#include <fmt/format.h>

#include "core/error.h"
#include "workflow/storage/checkpoint_items.h"
#include "workflow/storage/state_items.h"

namespace vitrel {
namespace {

template <class Run, class Visit>
void each_item(Run& run, Visit&& visit) {
  auto& state = run.state;
  each_item_of_counters(state.counters, "", visit);
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

}  // namespace

template <int Dim>
Checkpoint to_checkpoint(const RunCheckpoint<Dim>& run) {
  Checkpoint checkpoint;
  checkpoint.configuration = run.state.configuration;
  checkpoint.parameters = run.parameters;
  each_item(run, ItemWriter(checkpoint));
  return checkpoint;
}

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

template Checkpoint to_checkpoint(const RunCheckpoint<2>&);
template Checkpoint to_checkpoint(const RunCheckpoint<3>&);
template RunCheckpoint<2> run_from_checkpoint(const Checkpoint&, const std::filesystem::path&);
template RunCheckpoint<3> run_from_checkpoint(const Checkpoint&, const std::filesystem::path&);

}  // namespace vitrel
