#include "app/workflow/run_checkpoint.h"

#include <fmt/format.h>

#include "core/error.h"

namespace vitrel {
namespace {

// Names every number of a run once, for both directions.
template <class Run, class Real, class Counter>
void each_number(Run& run, Real&& real, Counter&& counter) {
  auto& state = run.state;
  real("virial", state.counters.virial);
  real("dissipated", state.counters.dissipated);
  real("start_time", state.start_time);
  real("flight_energy", state.flight_energy);
  real("energy_drift", state.energy_drift);
  real("largest_momentum", state.largest_momentum);
  real("wall_seconds", run.wall_seconds);
  counter("events", state.counters.events);
  counter("collisions", state.counters.collisions);
  counter("predictions", state.counters.predictions);
  counter("searches", state.counters.searches);
  counter("steps", state.counters.steps);
  counter("renewals", state.counters.renewals);
  counter("correction_moves", state.counters.correction_moves);
  counter("brownian_steps", state.brownian_steps);
  counter("next_sample", state.next_sample);
  counter("complete", run.complete);
}

template <class Map>
typename Map::mapped_type find(const Map& numbers, const char* name,
                               const std::filesystem::path& file) {
  const auto found = numbers.find(name);
  if (found == numbers.end())
    throw FileError(
        fmt::format("{}: no checkpoint of a run: the number '{}' is missing; delete it "
                    "and the trajectory to start anew",
                    file.string(), name));
  return found->second;
}

}  // namespace

Checkpoint to_checkpoint(const StoredRun& run) {
  Checkpoint checkpoint;
  checkpoint.configuration = run.state.configuration;
  checkpoint.parameters = run.parameters;
  each_number(
      run, [&](const char* name, double value) { checkpoint.reals[name] = value; },
      [&](const char* name, std::uint64_t value) { checkpoint.counters[name] = value; });
  return checkpoint;
}

StoredRun from_checkpoint(const Checkpoint& checkpoint, const std::filesystem::path& file) {
  StoredRun run;
  run.state.configuration = checkpoint.configuration;
  run.parameters = checkpoint.parameters;
  each_number(
      run, [&](const char* name, double& value) { value = find(checkpoint.reals, name, file); },
      [&](const char* name, auto& value) {
        value = static_cast<std::remove_reference_t<decltype(value)>>(
            find(checkpoint.counters, name, file));
      });
  return run;
}

}  // namespace vitrel
