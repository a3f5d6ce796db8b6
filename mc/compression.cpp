#include "mc/compression.h"

#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "mc/hard_core.h"
#include "mc/pressure_sampler.h"

namespace vitrel {

namespace {

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Returns whether the packing fraction has stopped rising.
bool has_converged(const std::vector<double>& all) {
  constexpr std::size_t least = 4000;
  constexpr double rise = 1e-3;
  if (all.size() < least) return false;
  const std::size_t quarter = all.size() / 4;
  const std::span last(all.end() - static_cast<std::ptrdiff_t>(quarter), quarter);
  const std::span third(last.data() - quarter, quarter);
  return mean(last) < (1 + rise) * mean(third);
}

template <int Dim>
class Compression {
 public:
  Compression(Configuration<Dim>& configuration, const CompressionOptions& options,
              std::uint64_t seed, CompressionState& state)
      : configuration_(configuration),
        options_(options),
        state_(state),
        sampler_(configuration, options.pressure, options.change, seed, state.moves, state.box,
                 options.threads) {}

  StageReport run(const RunControl& control) {
    while (true) {
      if (at_packing_fraction()) return finish();
      if (has_stopped_rising())
        return {StageEnd::stalled, end_text("no longer rises at this pressure")};
      if (state_.moves.sweeps >= options_.sweeps)
        return options_.packing_fraction
                   ? StageReport{StageEnd::stalled,
                                 end_text("did not reach its target within the given sweeps")}
                   : StageReport{StageEnd::reached, "all sweeps were completed"};
      if (control.stop_requested()) return {StageEnd::stopped, "compression was stopped"};
      sweep();
      control.report_progress(
          {static_cast<double>(state_.moves.sweeps) / static_cast<double>(options_.sweeps),
           packing_fraction(configuration_), "packing fraction"});
      control.notify_resumable();
    }
  }

 private:
  bool at_packing_fraction() const {
    return options_.packing_fraction &&
           packing_fraction(configuration_) >= *options_.packing_fraction;
  }

  bool has_stopped_rising() const {
    constexpr std::uint64_t check_interval = 1000;
    return options_.packing_fraction && state_.moves.sweeps % check_interval == 0 &&
           has_converged(state_.packing_fraction);
  }

  bool adapts() const {
    return options_.packing_fraction || sampler_.moves().sweeps <= options_.sweeps / 2;
  }

  void sweep() {
    sampler_.sweep();
    if (adapts() && sampler_.moves().sweeps % sweeps_per_tuning == 0) sampler_.tune();
    state_.moves = sampler_.moves();
    state_.box = sampler_.box();
    state_.packing_fraction.push_back(packing_fraction(configuration_));
  }

  StageReport finish() {
    scale_to_packing_fraction(configuration_, *options_.packing_fraction);
    return {StageEnd::reached, "the packing fraction was reached"};
  }

  std::string end_text(const std::string& how) const {
    return "the packing fraction " + how + ": it is " +
           std::to_string(packing_fraction(configuration_)) + ", and the target is " +
           std::to_string(*options_.packing_fraction);
  }

  Configuration<Dim>& configuration_;
  const CompressionOptions& options_;
  CompressionState& state_;
  PressureSampler<ParticleShape<Dim>> sampler_;
};

}  // namespace

template <int Dim>
StageReport compress(Configuration<Dim>& configuration, const CompressionOptions& options,
                     std::uint64_t seed, CompressionState& state, const RunControl& control) {
  return Compression(configuration, options, seed, state).run(control);
}

template StageReport compress(Configuration2&, const CompressionOptions&, std::uint64_t,
                              CompressionState&, const RunControl&);
template StageReport compress(Configuration3&, const CompressionOptions&, std::uint64_t,
                              CompressionState&, const RunControl&);

}  // namespace vitrel
