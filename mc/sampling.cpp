#include "mc/sampling.h"

#include "mc/sampler.h"

namespace vitrel {

StageReport sample(Configuration2& configuration, const SamplingOptions& options,
                   std::uint64_t seed, SweepState& state, const Budget& budget) {
  Sampler sampler(configuration, seed, state, options.threads);
  while (state.sweeps < options.sweeps) {
    if (budget.stop_requested()) return {StageEnd::stopped, "sampling was stopped"};
    sampler.sweep();
    if (sampler.state().sweeps % sweeps_per_tuning == 0) sampler.tune();
    state = sampler.state();
    const auto done = static_cast<double>(state.sweeps);
    budget.tell({done / static_cast<double>(options.sweeps), done, "sweep"});
    budget.mark_resumable();
  }
  return {StageEnd::reached, "all sweeps were made"};
}

}  // namespace vitrel
