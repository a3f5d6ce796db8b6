#include "mc/sampling.h"

#include <string>

#include "mc/sampler.h"

namespace vitrel {

namespace {

/// `sampler` is a Sampler or an EventChain, and `state` its own.
template <class AnySampler, class State>
StageEnd make_sweeps(AnySampler& sampler, State& state, std::uint64_t sweeps,
                     std::uint64_t sweeps_between_tunings, const Budget& budget) {
  while (state.sweeps < sweeps) {
    if (budget.stop_requested()) return StageEnd::stopped;
    sampler.sweep();
    if (sampler.state().sweeps % sweeps_between_tunings == 0) sampler.tune();
    state = sampler.state();
    const auto done = static_cast<double>(state.sweeps);
    budget.tell({done / static_cast<double>(sweeps), done, "sweep"});
    budget.mark_resumable();
  }
  return StageEnd::reached;
}

std::string end_text(const ChainCounts& counts) {
  const std::string all = "all sweeps were made";
  if (counts.cut_short == 0) return all;
  return all + ", but " + std::to_string(counts.cut_short) + " of " +
         std::to_string(counts.chains) +
         " chains were cut short in jammed rows, against the balance";
}

}  // namespace

StageReport sample(Configuration2& configuration, const SamplingOptions& options,
                   std::uint64_t seed, SamplingState& state, const Budget& budget) {
  StageEnd end;
  if (options.moves == Moves::chains) {
    EventChain chains(configuration, {}, seed, state.chains);
    end = make_sweeps(chains, state.chains, options.sweeps, 1, budget);
  } else {
    Sampler sampler(configuration, seed, state.local, options.threads);
    sampler.set_exchanges(options.exchanges);
    end = make_sweeps(sampler, state.local, options.sweeps, sweeps_per_tuning, budget);
  }
  if (end == StageEnd::stopped) return {end, "sampling was stopped"};
  return {end, end_text(state.chains.counts)};
}

}  // namespace vitrel
