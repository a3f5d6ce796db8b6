#include "mc/swelling.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mc/disjoint.h"
#include "mc/sampler.h"

namespace vitrel {

namespace {

/// Largest shrink of the box in one step, as a factor.
constexpr double lowest_factor = 0.98;
/// Share of the way to the first touch that is used, so that pairs keep room to move.
constexpr double share = 0.95;

void add_counts(StageReport& sum, const StageReport& part) {
  sum.translations_tried += part.translations_tried;
  sum.translations_accepted += part.translations_accepted;
  sum.rotations_tried += part.rotations_tried;
  sum.rotations_accepted += part.rotations_accepted;
}

// Shrinks the box towards the wanted packing fraction as far as the closest pair allows.
void shrink(Configuration2& configuration, double wanted) {
  const double needed = std::sqrt(packing_fraction(configuration) / wanted);
  const double touch = shrink_to_contact(configuration, std::max(lowest_factor, needed - 1e-3));
  const double factor = 1 - share * (1 - touch);
  if (!(factor < 1)) return;
  const Configuration2 before = configuration;
  if (factor <= needed)
    scale_to_packing_fraction(configuration, wanted);
  else
    scale_box(configuration, factor);
  // The margin of a smaller box differs by rounding only; a pair that no longer keeps it vetoes.
  if (find_overlap(configuration)) configuration = before;
}

}  // namespace

StageReport swell(Configuration2& configuration, const SwellingOptions& options, std::uint64_t seed,
                  std::uint64_t& first_sweep, const Budget& budget) {
  StageReport report;
  const double start = packing_fraction(configuration);
  double translation = 0.1, rotation = 0.1;
  const auto reached = [&] {
    return packing_fraction(configuration) >= options.packing_fraction * (1 - 1e-13);
  };
  for (std::uint64_t sweep = 0; !reached(); ++sweep) {
    if (sweep == options.sweeps || budget.stop_requested()) {
      report.end = sweep == options.sweeps ? StageEnd::stuck : StageEnd::stopped;
      report.reason = "swelling ended at a packing fraction of " +
                      std::to_string(packing_fraction(configuration)) + " after " +
                      std::to_string(sweep) + " sweeps; " +
                      std::to_string(options.packing_fraction) + " was wanted";
      return report;
    }
    Sampler sampler(configuration, seed, first_sweep);
    sampler.set_steps(translation, rotation);
    sampler.sweep();
    sampler.tune();
    translation = sampler.translation_step();
    rotation = sampler.rotation_step();
    first_sweep = sampler.next_sweep();
    add_counts(report, sampler.counts());
    shrink(configuration, options.packing_fraction);
    const double now = packing_fraction(configuration);
    budget.tell({(now - start) / (options.packing_fraction - start), now, "packing fraction"});
  }
  report.reason = "the packing fraction was reached";
  return report;
}

}  // namespace vitrel
