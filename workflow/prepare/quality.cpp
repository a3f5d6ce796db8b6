#include "workflow/prepare/quality.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/io/number_text.h"
#include "workflow/prepare/backbone_report.h"

namespace vitrel {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Of the nematic correlation, in units of √⟨ab⟩.
constexpr double bin_width = 0.25;

double unit_length(const Configuration2& configuration) {
  double areas = 0;
  for (const Ellipse& shape : configuration.shape) areas += shape.a * shape.b;
  return std::sqrt(areas / static_cast<double>(configuration.size()));
}

/// 0 if the last stage was no growth, or too short a one to measure it.
double pressure_of_growth(const Preparation<2>& preparation) {
  return preparation.stages.back().growth.reduced_pressure;
}

void note_pressure(Quality& quality, const Preparation<2>& preparation) {
  using From = Quality::PressureFrom;
  const double grown = pressure_of_growth(preparation);
  if (quality.decorrelation && grown < min_jammed_pressure) {
    quality.pressure_from = From::sampling;
    quality.reduced_pressure = block_average(quality.decorrelation->compressibility);
  } else if (grown > 0) {
    quality.pressure_from = From::growth;
    quality.reduced_pressure = {grown, unknown, 0};
  } else {
    quality.reduced_pressure = {unknown, unknown, 0};
  }
}

std::string pressure_remark(const Quality& quality) {
  using From = Quality::PressureFrom;
  if (quality.pressure_from == From::growth) return "at the end of the growth";
  if (quality.pressure_from == From::nothing) return "not measured";
  return std::isfinite(quality.reduced_pressure.error)
             ? "Monte Carlo sampling"
             : "Monte Carlo sampling, too short for an error";
}

void add_nematic_rows(std::vector<QualityRow>& rows, const Quality& quality) {
  if (quality.rotors == 0) return;
  const double noise = nematic_order_by_chance(quality.rotors);
  rows.push_back({"nematic order S", fmt::format("{:.3f}", quality.nematic_order),
                  fmt::format("1: all parallel; {:.3f} on average without order", noise)});
  const NematicCorrelation& g = quality.nematic_correlation;
  if (g.distance.empty()) return;
  const double length = correlation_length(g);
  const double range = g.distance.front() + g.distance.back();
  rows.push_back({"nematic correlation",
                  std::isfinite(length) ? fmt::format("up to r = {:.3g}", length)
                                        : fmt::format("longer than {:.3g}", range),
                  std::isfinite(length) ? "g₂(r) stays below 1/e beyond" : "half the box"});
}

QualityRow decay_row(const std::string& name, const std::optional<std::uint64_t>& sweeps,
                     std::uint64_t measured, const std::string& remark) {
  return {
      name,
      sweeps ? fmt::format("{} sweeps", *sweeps) : fmt::format("longer than {} sweeps", measured),
      remark};
}

void add_time_rows(std::vector<QualityRow>& rows, const Quality& quality) {
  if (!quality.decorrelation) return;
  const Decorrelation& decorrelation = *quality.decorrelation;
  if (quality.rotors > 0)
    rows.push_back(decay_row("orientation time", decorrelation.orientation_time,
                             decorrelation.measured, "until ⟨cos 2(θ(t) − θ(0))⟩ < 1/e"));
  rows.push_back(decay_row("displacement time", decorrelation.displacement_time,
                           decorrelation.measured,
                           "until the particles have moved by their width 2b"));
}

}  // namespace

std::optional<Quality> measure_quality(const Preparation<2>& preparation,
                                       const Parameters& parameters, const RunControl& control,
                                       int threads) {
  const Configuration2& state = preparation.configuration;
  Quality quality;
  if (parameters.quality_sweeps > 0) {
    quality.decorrelation =
        measure_decorrelation(state, parameters.quality_sweeps, parameters.system.seed,
                              preparation.next_sweep, control, threads);
    if (!quality.decorrelation) return std::nullopt;
  }
  quality.particles = state.size();
  quality.rotors = rotor_count(state);
  quality.packing_fraction = packing_fraction(state);
  note_pressure(quality, preparation);
  quality.nematic_order = nematic_order(state);
  quality.nematic_correlation = nematic_correlation(state, bin_width * unit_length(state));
  quality.hexatic_order = hexatic_order(state);
  quality.overlaps = preparation.check.overlaps.size();
  quality.smallest_gap = preparation.check.smallest_gap;
  quality.backbone = backbone_at_pressure(state, quality.reduced_pressure.mean);
  return quality;
}

std::vector<QualityRow> quality_rows(const Quality& quality) {
  std::vector<QualityRow> rows = {
      {"packing fraction φ", fmt::format("{:.6g}", quality.packing_fraction), ""},
      {"reduced pressure βP/ρ",
       with_error(quality.reduced_pressure.mean, quality.reduced_pressure.error),
       pressure_remark(quality)}};
  add_nematic_rows(rows, quality);
  rows.push_back({"hexatic order ψ₆",
                  fmt::format("{:.3f}, local {:.3f}", quality.hexatic_order.global,
                              quality.hexatic_order.local),
                  "1: triangular lattice, 0: square lattice"});
  rows.push_back({"smallest gap",
                  std::isfinite(quality.smallest_gap) ? fmt::format("{:.3g}", quality.smallest_gap)
                                                      : "beyond the longest semi-axis",
                  fmt::format("exact check: {} overlaps", quality.overlaps)});
  add_backbone_rows(rows, quality.backbone, quality.particles);
  add_time_rows(rows, quality);
  return rows;
}

}  // namespace vitrel
