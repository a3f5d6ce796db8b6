#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "analysis/glass/glass_study.h"
#include "core/random/stream.h"
#include "core/special_values.h"

/// Runs with known relaxation times, as the analysis hands them over.
namespace vitrel {

/// P + (1 − P) exp(−t/τ) at 20 times a decade, up to half of the duration, with the error that makes
/// one of 1 % for τ: 0.01 (1 − P)/e.
inline Decay decay(double tau, double duration, double plateau = 0) {
  Decay result;
  for (double t = 0.1; t <= duration / 2; t *= std::pow(10, 0.05)) {
    result.time.push_back(t);
    result.value.push_back(plateau + (1 - plateau) * std::exp(-t / tau));
    result.error.push_back(0.01 * (1 - plateau) / std::exp(1));
  }
  return result;
}

inline std::vector<double> noise_about(double mean, double width, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  std::vector<double> series(512);
  for (double& value : series) value = mean + width * draw.normal();
  return series;
}

/// 500 rotors with relaxation times tau_t and tau_r, and nematic order S.
inline GlassRunData run_with(double packing_fraction, double tau_t, double tau_r, double order,
                             double duration = 1e4) {
  GlassRunData data{};
  data.name = "job";
  data.packing_fraction = packing_fraction;
  data.seed = 1;
  data.rotors = 500;
  data.duration = duration;
  data.scattering = decay(tau_t, duration);
  data.orientation = decay(tau_r, duration, order > 0.5 ? order * order : 0);
  data.nematic_order = noise_about(order, 0.01, 7);
  data.series = {{"the hexatic order", noise_about(0.3, 0.01, 8)}};
  data.diffusion = {1 / tau_t, 0.01 / tau_t, 1, 2, ""};
  data.rotational_diffusion = {unknown, unknown, unknown, unknown, "not reached"};
  return data;
}

/// Two seeds at eleven densities: τ_α diverges at 0.80, τ_2 at 0.76; runs last 2·10⁵.
inline GlassStudy studied_sweep() {
  std::vector<GlassRun> runs;
  Stream draw(3, Purpose::tests);
  for (int k = 0; k <= 10; ++k)
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const double phi = 0.58 + 0.02 * k;
      const double tau_t = 0.5 * std::pow(0.80 - phi, -2.5) * std::exp(0.01 * draw.normal());
      const double tau_r =
          phi < 0.76 ? std::pow(0.76 - phi, -2) * std::exp(0.01 * draw.normal()) : 1e9;
      GlassRunData data = run_with(phi, tau_t, tau_r, 0.05, 2e5);
      data.seed = seed;
      data.name = "job_" + std::to_string(k);
      runs.push_back(judge_glass_run(data));
    }
  return study_glass(std::move(runs));
}

inline const GlassFit& fit_of(const GlassStudy& study, GlassKind kind, GlassLaw law) {
  for (const StudiedLaw& studied : study.laws)
    if (studied.kind == kind && studied.law == law) return studied.fit;
  throw std::logic_error("no such law");
}

}  // namespace vitrel
