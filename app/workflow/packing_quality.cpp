#include "app/workflow/packing_quality.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/workflow/text_file.h"

namespace vitrel {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Of the last stage that grew for long enough to measure it.
double pressure_of_growth(const Preparation<3>& preparation) {
  double pressure = unknown;
  for (const StageRecord& stage : preparation.stages)
    if (stage.growth.reduced_pressure > 0) pressure = stage.growth.reduced_pressure;
  return pressure;
}

std::string or_dash(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "–";
}

QualityRow orientation_row(const PackingQuality& quality) {
  const IsotropicRatio chance = isotropic_ratio(quality.axes);
  return {"orientation ratio ρ", or_dash(quality.orientation_ratio, "{:.4f}"),
          fmt::format("λ_max/λ_min; isotropic: {:.4f} ± {:.4f}", chance.mean,
                      chance.standard_deviation)};
}

}  // namespace

PackingQuality measure_quality(const Preparation<3>& preparation) {
  const Configuration3& packing = preparation.configuration;
  const OrientationTensor tensor = orientation_tensor(packing);
  PackingQuality quality;
  quality.particles = packing.size();
  quality.packing_fraction = packing_fraction(packing);
  quality.reduced_pressure = pressure_of_growth(preparation);
  quality.axes = tensor.axes;
  quality.orientation_ratio = tensor.axes > 0 ? tensor.ratio() : unknown;
  quality.overlaps = preparation.check.overlaps.size();
  quality.smallest_gap = preparation.check.smallest_gap;
  for (const StageRecord& stage : preparation.stages)
    quality.collisions += stage.growth.counters.collisions;
  quality.wall_seconds = preparation.wall_seconds;
  return quality;
}

std::vector<QualityRow> quality_rows(const PackingQuality& quality) {
  std::vector<QualityRow> rows = {
      {"packing fraction φ", fmt::format("{:.6g}", quality.packing_fraction), ""},
      {"reduced pressure βP/ρ", or_dash(quality.reduced_pressure, "{:.4g}"),
       "at the end of the growth"}};
  if (quality.axes > 0) rows.push_back(orientation_row(quality));
  rows.push_back({"smallest gap",
                  std::isfinite(quality.smallest_gap) ? fmt::format("{:.3g}", quality.smallest_gap)
                                                      : "beyond the longest semi-axis",
                  fmt::format("exact check: {} overlaps", quality.overlaps)});
  rows.push_back({"collisions", fmt::format("{}", quality.collisions),
                  fmt::format("{:.3g} per particle", static_cast<double>(quality.collisions) /
                                                         static_cast<double>(quality.particles))});
  rows.push_back({"wall time", fmt::format("{:.4g} s", quality.wall_seconds), ""});
  return rows;
}

nlohmann::ordered_json quality_json(const PackingQuality& quality) {
  const IsotropicRatio chance = isotropic_ratio(quality.axes);
  return {{"dimension", 3},
          {"particles", quality.particles},
          {"packing_fraction", quality.packing_fraction},
          {"reduced_pressure", quality.reduced_pressure},
          {"axes", quality.axes},
          {"orientation_ratio", quality.orientation_ratio},
          {"isotropic_ratio", chance.mean},
          {"isotropic_ratio_deviation", chance.standard_deviation},
          {"overlaps", quality.overlaps},
          {"smallest_gap", quality.smallest_gap},
          {"collisions", quality.collisions},
          {"wall_seconds", quality.wall_seconds}};
}

void write_quality(const std::filesystem::path& file, const PackingQuality& quality) {
  write_text(file, quality_json(quality).dump(1) + "\n");
}

}  // namespace vitrel
