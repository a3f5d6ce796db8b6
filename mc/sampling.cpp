#include "mc/sampling.h"

#include <string>

#include "mc/sampler.h"

namespace vitrel {

namespace {

/// `sampler` is a Sampler or an EventChain, and `state` its own.
template <class AnySampler, class State>
StageEnd run_sweeps(AnySampler& sampler, State& state, std::uint64_t sweeps,
                    std::uint64_t sweeps_between_tunings, const RunControl& control) {
  while (state.sweeps < sweeps) {
    if (control.stop_requested()) return StageEnd::stopped;
    sampler.sweep();
    if (sampler.state().sweeps % sweeps_between_tunings == 0) sampler.tune();
    state = sampler.state();
    const auto done = static_cast<double>(state.sweeps);
    control.report_progress({done / static_cast<double>(sweeps), done, "sweep"});
    control.notify_resumable();
  }
  return StageEnd::reached;
}

std::string end_text(const ChainCounts& counts) {
  std::string all = "all sweeps were completed";
  if (counts.cut_short == 0) return all;
  return all + ", but " + std::to_string(counts.cut_short) + " of " +
         std::to_string(counts.chains) +
         " chains were cut short in jammed rows, which violates balance";
}

}  // namespace

template <int Dim>
StageReport sample(Configuration<Dim>& configuration, const SamplingOptions& options,
                   std::uint64_t seed, SamplingState& state, const RunControl& control) {
  StageEnd end;
  if (options.moves == Moves::chains) {
    EventChain chains(configuration, {.exchanges = options.exchanges}, seed, state.chains);
    end = run_sweeps(chains, state.chains, options.sweeps, 1, control);
  } else {
    Sampler sampler(configuration, seed, state.local, options.threads);
    sampler.set_exchanges(options.exchanges);
    end = run_sweeps(sampler, state.local, options.sweeps, sweeps_per_tuning, control);
  }
  if (end == StageEnd::stopped) return {end, "sampling was stopped"};
  return {end, end_text(state.chains.counts)};
}

template StageReport sample(Configuration2&, const SamplingOptions&, std::uint64_t, SamplingState&,
                            const RunControl&);
template StageReport sample(Configuration3&, const SamplingOptions&, std::uint64_t, SamplingState&,
                            const RunControl&);

}  // namespace vitrel
