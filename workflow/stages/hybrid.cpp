#include "workflow/stages/hybrid.h"

#include <algorithm>
#include <limits>

#include "core/elementary.h"

namespace vitrel {
namespace {

/// Upper bound of the growth of all lengths in one interval, times Z.
constexpr double largest_compression = 0.2;

template <int Dim>
class Hybrid {
 public:
  Hybrid(Configuration<Dim>& configuration, const HybridOptions& options, HybridState& state,
         const RunControl& control)
      : configuration_(configuration),
        options_(options),
        state_(state),
        control_(control),
        start_(packing_fraction(configuration)),
        silent_{control.should_stop, {}, control.on_resumable} {}

  StageReport run() {
    while (true) {
      const bool grows = state_.stretches % 2 == 0;
      const StageReport report = grows ? growth() : sampling();
      if (report.end != StageEnd::reached) return report;
      if (grows && at_pressure()) return {report.end, "the reduced pressure was reached"};
      if (grows && state_.stretch_end == goal()) return report;
      ++state_.stretches;
      state_.stretch_end = 0;
      control_.report_progress({progress(), packing_fraction(configuration_), "packing fraction"});
      control_.notify_resumable();
    }
  }

 private:
  StageReport growth() {
    if (state_.stretch_end == 0) state_.stretch_end = next_end();
    GrowthOptions growth;
    growth.growth_rate = options_.growth_rate;
    growth.packing_fraction = state_.stretch_end;
    growth.reduced_pressure = options_.reduced_pressure;
    growth.seed = options_.seed;
    return grow(configuration_, growth, state_.growth, silent_);
  }

  double next_end() const {
    const double z = std::max(1.0, state_.growth.reduced_pressure);
    const double size = 1 + std::min(largest_growth_of_stretch, largest_compression / z);
    const double area = packing_fraction(configuration_) * size * size;
    return std::min(Dim == 2 ? area : area * size, goal());
  }

  double goal() const {
    return options_.packing_fraction.value_or(std::numeric_limits<double>::infinity());
  }

  /// True at the end of an interval of growth that has reached the target pressure, whichever goal ended it.
  bool at_pressure() const {
    return options_.reduced_pressure &&
           state_.growth.reduced_pressure >= *options_.reduced_pressure;
  }

  StageReport sampling() {
    SamplingOptions sampling = options_.stretch;
    sampling.sweeps *= (state_.stretches + 1) / 2;  // of all intervals of Monte Carlo so far
    return sample(configuration_, sampling, options_.seed, state_.sampling, silent_);
  }

  double progress() const {
    double done = 0;
    if (options_.packing_fraction)
      done = logarithm(packing_fraction(configuration_) / start_) / logarithm(goal() / start_);
    if (options_.reduced_pressure)
      done = std::max(done, logarithm(std::max(1.0, state_.growth.reduced_pressure)) /
                                logarithm(*options_.reduced_pressure));
    return std::clamp(done, 0.0, 1.0);
  }

  Configuration<Dim>& configuration_;
  const HybridOptions& options_;
  HybridState& state_;
  const RunControl& control_;
  const double start_;
  const RunControl silent_;  // because progress is that of the whole stage
};

}  // namespace

template <int Dim>
StageReport hybrid(Configuration<Dim>& configuration, const HybridOptions& options,
                   HybridState& state, const RunControl& control) {
  return Hybrid(configuration, options, state, control).run();
}

template StageReport hybrid(Configuration2&, const HybridOptions&, HybridState&, const RunControl&);
template StageReport hybrid(Configuration3&, const HybridOptions&, HybridState&, const RunControl&);

}  // namespace vitrel
