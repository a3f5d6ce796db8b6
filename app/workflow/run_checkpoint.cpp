#include "app/workflow/run_checkpoint.h"

#include "app/workflow/checkpoint_items.h"
#include "app/workflow/state_items.h"

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
  visit("brownian_steps", state.brownian_steps);
  visit("next_sample", state.next_sample);
  visit("next_tick", state.next_tick);
  visit("correlations", run.correlations);
  visit("complete", run.complete);
}

}  // namespace

Checkpoint to_checkpoint(const StoredRun& run) {
  Checkpoint checkpoint;
  checkpoint.configuration = run.state.configuration;
  checkpoint.parameters = run.parameters;
  each_item(run, ItemWriter(checkpoint));
  return checkpoint;
}

StoredRun from_checkpoint(const Checkpoint& checkpoint, const std::filesystem::path& file) {
  StoredRun run;
  run.state.configuration = std::get<Configuration2>(checkpoint.configuration);
  run.parameters = checkpoint.parameters;
  each_item(run, ItemReader(checkpoint, file));
  return run;
}

}  // namespace vitrel
