#include "workflow/prepare/quality.h"

#include <fmt/format.h>

#include <cmath>

namespace vitrel {
namespace {

/// Of the nematic correlation, in units of √⟨ab⟩.
constexpr double bin_width = 0.25;

double unit_length(const Configuration2& configuration) {
  double areas = 0;
  for (const Ellipse& shape : configuration.shape) areas += shape.a * shape.b;
  return std::sqrt(areas / static_cast<double>(configuration.size()));
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

}  // namespace

std::optional<Quality> measure_quality(const Preparation<2>& preparation,
                                       const Parameters& parameters, const RunControl& control,
                                       int threads) {
  Quality quality;
  if (!measure_state(quality, preparation, parameters, control, threads)) return std::nullopt;
  const Configuration2& state = preparation.configuration;
  quality.nematic_order = nematic_order(state);
  if (parameters.quality_sweeps > 0)
    quality.nematic_correlation = nematic_correlation(state, bin_width * unit_length(state));
  quality.hexatic_order = hexatic_order(state);
  return quality;
}

std::vector<QualityRow> quality_rows(const Quality& quality) {
  std::vector<QualityRow> rows = {packing_fraction_row(quality), pressure_row(quality)};
  add_nematic_rows(rows, quality);
  rows.push_back({"hexatic order ψ₆",
                  fmt::format("{:.3f}, local {:.3f}", quality.hexatic_order.global,
                              quality.hexatic_order.local),
                  "1: triangular lattice, 0: square lattice"});
  rows.push_back(gap_row(quality));
  add_backbone_rows(rows, quality);
  add_time_rows(rows, quality, "⟨cos 2(θ(t) − θ(0))⟩");
  return rows;
}

}  // namespace vitrel
