#include "mc/compression.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "mc/disjoint.h"

namespace vitrel {

namespace {

double aspect(const PeriodicBox<2>& box) {
  return box.lengths().y() / box.lengths().x();
}

}  // namespace

PressureSampler::PressureSampler(Configuration2& configuration, double pressure, BoxChange change,
                                 std::uint64_t seed, std::uint64_t first_sweep, int threads)
    : configuration_(configuration),
      pressure_(pressure),
      change_(change),
      seed_(seed),
      aspect_at_start_(aspect(configuration.box)),
      moves_(configuration, seed, first_sweep, threads) {}

void PressureSampler::sweep() {
  try_box(Stream(seed_, Purpose::box_trials, moves_.next_sweep()));
  moves_.sweep();
}

void PressureSampler::try_box(Stream draw) {
  ++tried_;
  const double growth = draw.uniform(-box_step_.size(), box_step_.size());  // of ln V
  Vec2 factors = Vec2::Constant(std::exp(0.5 * growth));
  if (change_ == BoxChange::anisotropic) {
    const auto side = static_cast<Eigen::Index>(draw.below(2));
    factors = Vec2::Ones();
    factors[side] = std::exp(growth);
    const double change = factors.y() / factors.x() * aspect(configuration_.box) / aspect_at_start_;
    if (change > widest_change || change < 1 / widest_change) return;
  }
  const double volume = configuration_.box.volume();
  const auto exponent = static_cast<double>(configuration_.size() + 1);
  const double weight = exponent * growth - pressure_ * volume * std::expm1(growth);
  if (draw.uniform() >= std::exp(weight)) return;
  if (moves_.rescale(factors)) ++accepted_;
}

void PressureSampler::tune() {
  constexpr std::uint64_t enough = 20;
  constexpr double widest = 0.1;
  moves_.tune();
  box_step_.tune(tried_, accepted_, enough, widest);
}

namespace {

constexpr std::uint64_t sweeps_per_tuning = 20;

/// The packing fractions after every sweep.
class Record {
 public:
  void add(double packing_fraction) { values_.push_back(packing_fraction); }
  double mean_of_second_half() const { return mean(values_.size() / 2, values_.size()); }
  bool has_come_to_rest() const {
    constexpr std::size_t least = 4000;
    constexpr double rise = 1e-3;
    const std::size_t n = values_.size();
    return n >= least && mean(n - n / 4, n) < (1 + rise) * mean(n / 2, n - n / 4);
  }

 private:
  double mean(std::size_t begin, std::size_t end) const {
    if (begin == end) return 0;
    const std::span some(values_.data() + begin, values_.data() + end);
    return std::accumulate(some.begin(), some.end(), 0.0) / static_cast<double>(some.size());
  }

  std::vector<double> values_;
};

}  // namespace

CompressionReport compress(Configuration2& configuration, const CompressionOptions& options,
                           std::uint64_t seed, std::uint64_t& first_sweep, const Budget& budget) {
  const std::uint64_t between_looks = 1000;
  PressureSampler sampler(configuration, options.pressure, options.change, seed, first_sweep,
                          options.threads);
  Record record;
  const auto reached = [&] {
    return options.packing_fraction && packing_fraction(configuration) >= *options.packing_fraction;
  };
  StageEnd end = options.packing_fraction ? StageEnd::stuck : StageEnd::reached;
  std::string reason =
      options.packing_fraction ? "the sweeps were used up" : "all sweeps were made";
  for (std::uint64_t done = 0; done < options.sweeps && !reached();) {
    if (budget.stop_requested()) {
      end = StageEnd::stopped, reason = "the compression was stopped";
      break;
    }
    sampler.sweep();
    record.add(packing_fraction(configuration));
    if (++done % sweeps_per_tuning == 0) sampler.tune();
    budget.tell({static_cast<double>(done) / static_cast<double>(options.sweeps),
                 packing_fraction(configuration), "packing fraction"});
    if (options.packing_fraction && done % between_looks == 0 && record.has_come_to_rest()) {
      reason = "the packing fraction no longer rises at this pressure";
      break;
    }
  }
  CompressionReport report{sampler.moves().counts()};
  report.sweeps = sampler.moves().next_sweep() - first_sweep;
  first_sweep += report.sweeps;
  if (reached()) {
    scale_to_packing_fraction(configuration, *options.packing_fraction);
    end = StageEnd::reached, reason = "the packing fraction was reached";
  }
  report.end = end;
  report.reason = reason;
  report.packing_fraction = record.mean_of_second_half();
  return report;
}

}  // namespace vitrel
