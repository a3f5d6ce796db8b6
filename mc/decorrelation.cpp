#include "mc/decorrelation.h"

#include <cmath>
#include <numbers>

#include "core/state/figure_axis.h"
#include "mc/contact_pressure.h"
#include "mc/sampler.h"

namespace vitrel {

namespace {

constexpr std::uint64_t tuning_share = 5;  // a fifth of the sweeps
constexpr std::uint64_t sweeps_between_tunings = 5, sweeps_per_pressure = 5;
constexpr double spacing = 1.0797751623277097 * (1 - 1e-9);  // 30 per decade

template <int Dim>
double orientation_correlation(const Configuration<Dim>& before, const Configuration<Dim>& now) {
  double sum = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (!now.shape[i].is_round()) sum += alignment(before, i, now, i);
  return sum / static_cast<double>(rotor_count(now));
}

template <int Dim>
double displacement_in_widths(const Configuration<Dim>& before, const Configuration<Dim>& now) {
  double sum = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double width = 2 * now.shape[i].inradius();
    sum += squared_norm(now.unwrapped(i) - before.unwrapped(i)) / (width * width);
  }
  return std::sqrt(sum / static_cast<double>(now.size()));
}

/// Compares configurations with the first one.
template <int Dim>
class Comparison {
 public:
  Comparison(const Configuration<Dim>& start, Decorrelation& result)
      : start_(start), rotors_(rotor_count(start) > 0), result_(result) {}

  void compare(const Configuration<Dim>& now, std::uint64_t t) {
    const double moved = displacement_in_widths(start_, now);
    if (!result_.displacement_time && moved > 1) result_.displacement_time = t;
    const double kept = rotors_ ? orientation_correlation(start_, now) : 1;
    if (!result_.orientation_time && kept < 1 / std::numbers::e) result_.orientation_time = t;
    result_.measured = t;
    const auto time = static_cast<double>(t);
    if (!result_.sweeps.empty() && time < spacing * result_.sweeps.back()) return;
    result_.sweeps.push_back(time);
    result_.displacement.push_back(moved);
    if (rotors_) result_.orientation.push_back(kept);
  }

 private:
  const Configuration<Dim> start_;
  const bool rotors_;
  Decorrelation& result_;
};

}  // namespace

template <int Dim>
std::optional<Decorrelation> measure_decorrelation(const Configuration<Dim>& configuration,
                                                   std::uint64_t sweeps, std::uint64_t seed,
                                                   std::uint64_t first_sweep,
                                                   const RunControl& control, int threads) {
  Configuration<Dim> copy = configuration;
  Sampler sampler(copy, seed, {.next_sweep = first_sweep}, threads);
  const auto sweep = [&](std::uint64_t done) {
    if (control.stop_requested()) return false;
    sampler.sweep();
    control.report_progress({static_cast<double>(done + 1) / static_cast<double>(sweeps),
                             static_cast<double>(done + 1), "sweep"});
    return true;
  };
  const std::uint64_t tuning = sweeps / tuning_share;
  for (std::uint64_t k = 0; k < tuning; ++k) {
    if (!sweep(k)) return std::nullopt;
    if ((k + 1) % sweeps_between_tunings == 0) sampler.tune();
  }
  Decorrelation result;
  Comparison comparison(copy, result);
  ContactPressure pressure;
  for (std::uint64_t t = 1; t <= sweeps - tuning; ++t) {
    if (!sweep(tuning + t - 1)) return std::nullopt;
    comparison.compare(copy, t);
    if (t % sweeps_per_pressure != 1) continue;
    result.compressibility.push_back(pressure.add(copy));
  }
  if (!result.compressibility.empty()) result.compressibility_bias = pressure.extrapolation_error();
  return result;
}

template std::optional<Decorrelation> measure_decorrelation(const Configuration2&, std::uint64_t,
                                                            std::uint64_t, std::uint64_t,
                                                            const RunControl&, int);
template std::optional<Decorrelation> measure_decorrelation(const Configuration3&, std::uint64_t,
                                                            std::uint64_t, std::uint64_t,
                                                            const RunControl&, int);

}  // namespace vitrel
