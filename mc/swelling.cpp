#include "mc/swelling.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "core/tolerances.h"
#include "mc/disjoint.h"
#include "mc/sampler.h"

namespace vitrel {

namespace {

/// Sweeps in which all particles should find room, and sweeps that count as fast.
constexpr std::uint64_t patience = 40, fast = 12;
/// Limits of the growth g − 1 in one round.
constexpr double smallest_growth = 1e-9, largest_growth = 0.02;
/// Share of the way to the first touch that is used, so that pairs keep room to move.
constexpr double share = 0.95;
/// Jammed: a relative rise of the packing fraction below this in so many sweeps.
constexpr std::uint64_t jamming_sweeps = 5000;
constexpr double jamming_rise = 1e-4;

Ellipse enlarged(const Ellipse& shape, double factor) {
  return {shape.a * factor, shape.b * factor};
}

class Swelling {
 public:
  Swelling(Configuration2& configuration, const SwellingOptions& options, std::uint64_t seed,
           std::uint64_t first_sweep)
      : configuration_(configuration),
        options_(options),
        shapes_(configuration.shape),
        seed_(seed),
        first_sweep_(first_sweep),
        sweep_(first_sweep) {}

  StageReport run(const Budget& budget) {
    const double start = packing_fraction(configuration_);
    if (start > options_.packing_fraction) finish();
    while (!reached()) {
      if (budget.stop_requested()) return ended(StageEnd::stopped, "was stopped");
      if (used_up()) return ended(StageEnd::stuck, "used up its sweeps");
      if (jammed()) return ended(StageEnd::stuck, "found the particles jammed");
      round(budget);
      const double now = packing_fraction(configuration_);
      budget.tell({(now - start) / (options_.packing_fraction - start), now, "packing fraction"});
    }
    report_.reason = "the packing fraction was reached";
    return report_;
  }

  std::uint64_t next_sweep() const { return sweep_; }

 private:
  bool reached() const {
    return packing_fraction(configuration_) >=
           options_.packing_fraction * (1 - tolerance::given_fraction);
  }
  bool used_up() const { return sweep_ - first_sweep_ >= options_.sweeps; }

  bool jammed() {
    if (sweep_ - watched_sweep_ < jamming_sweeps) return false;
    const double before = watched_fraction_;
    watched_sweep_ = sweep_;
    watched_fraction_ = packing_fraction(configuration_);
    return watched_fraction_ < before * (1 + jamming_rise);
  }

  StageReport ended(StageEnd end, const std::string& how) {
    report_.end = end;
    report_.reason = "swelling " + how + " at a packing fraction of " +
                     std::to_string(packing_fraction(configuration_)) + " after " +
                     std::to_string(sweep_ - first_sweep_) + " sweeps; " +
                     std::to_string(options_.packing_fraction) + " was wanted";
    return report_;
  }

  // One round, from the present growth; adapts the growth of the next.
  void round(const Budget& budget) {
    const Configuration2 before = configuration_;
    const double needed =
        std::sqrt(options_.packing_fraction / packing_fraction(configuration_)) - 1;
    double growth = std::min(growth_, needed);
    const std::uint64_t began = sweep_;
    const bool all = enlarge_all(growth, budget);
    configuration_.shape = shapes_;
    if (!all)
      shrink_to_closest_pair();
    else if (growth == needed)
      finish();
    else
      scale_box(configuration_, 1 / (1 + growth));
    growth_ = sweep_ - began <= fast ? std::min(largest_growth, 1.5 * growth_)
                                     : std::max(smallest_growth, growth);
    // Rounding alone could cost a pair its margin; then the round does not count.
    if (find_overlap(configuration_)) configuration_ = before;
  }

  // Sweeps, and between them enlarges one particle after another. The growth is halved for all as
  // often as some find no room; false if that does not help.
  bool enlarge_all(double& growth, const Budget& budget) {
    Sampler sampler(configuration_, seed_, sweep_, options_.threads);
    sampler.set_steps(translation_, rotation_);
    std::vector<std::size_t> waiting(configuration_.size());
    std::iota(waiting.begin(), waiting.end(), 0);
    while (enlarge_waiting(sampler, waiting, growth, budget) && growth > smallest_growth) {
      growth *= 0.5;
      for (std::size_t i = 0; i < shapes_.size(); ++i)
        if (configuration_.shape[i].a != shapes_[i].a)
          configuration_.shape[i] = enlarged(shapes_[i], 1 + growth);
    }
    translation_ = sampler.translation_step();
    rotation_ = sampler.rotation_step();
    report_.add_counts(sampler.counts());
    return waiting.empty();
  }

  // True if patience ended with particles still waiting.
  bool enlarge_waiting(Sampler& sampler, std::vector<std::size_t>& waiting, double growth,
                       const Budget& budget) {
    for (std::uint64_t k = 0; k < patience && !waiting.empty(); ++k) {
      if (used_up() || budget.stop_requested()) return false;
      sampler.sweep();
      sampler.tune();
      sweep_ = sampler.next_sweep();
      std::erase_if(waiting, [&](std::size_t i) {
        return sampler.reshape(i, enlarged(shapes_[i], 1 + growth));
      });
    }
    return !waiting.empty();
  }

  void shrink_to_closest_pair() {
    const double needed = std::sqrt(packing_fraction(configuration_) / options_.packing_fraction);
    const double lowest = std::max(needed, 1 / (1 + largest_growth));
    const double factor = 1 - share * (1 - shrink_to_contact(configuration_, lowest));
    if (factor < 1) scale_box(configuration_, factor);
  }

  void finish() { scale_to_packing_fraction(configuration_, options_.packing_fraction); }

  Configuration2& configuration_;
  const SwellingOptions& options_;
  const std::vector<Ellipse> shapes_;
  const std::uint64_t seed_, first_sweep_;
  std::uint64_t sweep_;
  std::uint64_t watched_sweep_ = sweep_;
  double watched_fraction_ = 0;
  double growth_ = largest_growth;
  double translation_ = 0.1, rotation_ = 0.1;
  StageReport report_;
};

}  // namespace

StageReport swell(Configuration2& configuration, const SwellingOptions& options, std::uint64_t seed,
                  std::uint64_t& first_sweep, const Budget& budget) {
  Swelling swelling(configuration, options, seed, first_sweep);
  StageReport report = swelling.run(budget);
  first_sweep = swelling.next_sweep();
  return report;
}

}  // namespace vitrel
