#include "workflow/prepare/packing_quality.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/io/json.h"
#include "core/io/text_file.h"
#include "core/special_values.h"

namespace vitrel {
namespace {

std::string components(const Mat3& tensor) {
  // Zero without the sign of a rounding error.
  const Mat3 t = (1000 * tensor).array().round() / 1000 + 0.0;
  return fmt::format("{:.3f}, {:.3f}, {:.3f}; {:.3f}, {:.3f}, {:.3f}", t(0, 0), t(1, 1), t(2, 2),
                     t(1, 2), t(0, 2), t(0, 1));
}

QualityRow tensor_row(const PackingQuality& quality) {
  const auto& first = quality.first_orientation_tensor;
  return {"orientation tensor ⟨w wᵀ⟩", components(quality.orientation_tensor),
          first ? fmt::format("xx, yy, zz; yz, xz, xy; at the start {}", components(*first))
                : "xx, yy, zz; yz, xz, xy"};
}

Json tensor_json(const Mat3& tensor) {
  Json rows = Json::array();
  for (const auto row : tensor.rowwise()) rows.push_back({row[0], row[1], row[2]});
  return rows;
}

Mat3 tensor_from(const Json& rows) {
  Mat3 tensor;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      tensor(static_cast<int>(i), static_cast<int>(k)) = rows.at(i).at(k);
  return tensor;
}

Json two_point_json(const TwoPointStatistics& found) {
  return {{"spacing", found.spacing},
          {"r", found.distance},
          {"s2", found.probability},
          {"lineal_path_x", found.lineal_path[0]},
          {"lineal_path_y", found.lineal_path[1]},
          {"lineal_path_z", found.lineal_path[2]}};
}

QualityRow orientation_row(const PackingQuality& quality) {
  const IsotropicRatio chance = isotropic_ratio(quality.rotors);
  return {"orientation ratio ρ", fmt::format("{:.4f}", quality.orientation_ratio),
          fmt::format("λ_max/λ_min; isotropic: {:.4f} ± {:.4f}", chance.mean,
                      chance.standard_deviation)};
}

void measure_structure(PackingQuality& quality, const Configuration3& packing) {
  const OrientationTensor tensor = orientation_tensor(packing);
  quality.orientation_tensor = tensor.matrix;
  quality.orientation_ratio = tensor.ratio();
  quality.two_point = TwoPointGrid(packing).measure(packing);
}

/// What reports of earlier versions lack is unknown; their pressure is that of a growth.
void read_pressure(PackingQuality& quality, const Json& report) {
  quality.reduced_pressure = {
      number_or(report.at("reduced_pressure"), unknown),
      number_or(report.value("reduced_pressure_error", Json(nullptr)), unknown), 0};
  const bool known = std::isfinite(quality.reduced_pressure.mean);
  quality.pressure_from =
      pressure_source(report.value("reduced_pressure_from", known ? "growth" : "nothing"));
}

}  // namespace

PackingQuality measure_quality(const Configuration3& packing, const ExactCheck<3>& check) {
  PackingQuality quality;
  quality.particles = packing.size();
  quality.rotors = rotor_count(packing);
  quality.packing_fraction = packing_fraction(packing);
  quality.reduced_pressure = {unknown, unknown, 0};
  quality.overlaps = check.overlaps.size();
  quality.smallest_gap = check.smallest_gap;
  measure_structure(quality, packing);
  return quality;
}

std::optional<PackingQuality> measure_quality(const Preparation<3>& preparation,
                                              const Parameters& parameters,
                                              const RunControl& control, int threads) {
  PackingQuality quality;
  if (!measure_state(quality, preparation, parameters, control, threads)) return std::nullopt;
  measure_structure(quality, preparation.configuration);
  if (preparation.stages.front().orientation_tensor.size() == 9)
    quality.first_orientation_tensor = Mat3(preparation.stages.front().orientation_tensor.data());
  for (const StageRecord& stage : preparation.stages)
    quality.collisions += stage.growth.counters.collisions;
  quality.wall_seconds = preparation.wall_seconds;
  return quality;
}

void add_preparation(PackingQuality& quality, const std::filesystem::path& file) {
  read_json_as("a quality report", file, [&](const Json& report) {
    if (report.at("particles") != quality.particles ||
        report.at("packing_fraction") != quality.packing_fraction)
      throw FileError(
          fmt::format("{}: is the quality report of another packing; vitrel prepare "
                      "writes both files together",
                      file.string()));
    read_pressure(quality, report);
    if (report.contains("first_orientation_tensor"))
      quality.first_orientation_tensor = tensor_from(report.at("first_orientation_tensor"));
    if (report.contains("rattlers")) quality.backbone = backbone_from(report);
    quality.decorrelation = decorrelation_from(report.value("time_correlation", Json(nullptr)));
    quality.collisions = report.at("collisions");
    quality.wall_seconds = report.at("wall_seconds");
  });
}

std::vector<QualityRow> quality_rows(const PackingQuality& quality) {
  std::vector<QualityRow> rows = {packing_fraction_row(quality)};
  if (quality.pressure_from != StateQuality::PressureFrom::nothing)
    rows.push_back(pressure_row(quality));
  if (quality.rotors > 0) {
    rows.push_back(tensor_row(quality));
    rows.push_back(orientation_row(quality));
  }
  rows.push_back(gap_row(quality));
  add_backbone_rows(rows, quality);
  add_time_rows(rows, quality, "⟨P₂(w(t)·w(0))⟩");
  if (quality.collisions > 0)
    rows.push_back(
        {"collisions", fmt::format("{}", quality.collisions),
         fmt::format("{:.3g} per particle", static_cast<double>(quality.collisions) /
                                                static_cast<double>(quality.particles))});
  if (quality.wall_seconds > 0)
    rows.push_back({"wall time", fmt::format("{:.4g} s", quality.wall_seconds), ""});
  return rows;
}

Json quality_json(const PackingQuality& quality) {
  const IsotropicRatio chance = isotropic_ratio(quality.rotors);
  Json json = {{"dimension", 3},
               {"particles", quality.particles},
               {"packing_fraction", quality.packing_fraction},
               {"reduced_pressure", quality.reduced_pressure.mean},
               {"reduced_pressure_error", quality.reduced_pressure.error},
               {"reduced_pressure_from", name_of(quality.pressure_from)},
               {"axes", quality.rotors},
               {"orientation_tensor", tensor_json(quality.orientation_tensor)},
               {"orientation_ratio", quality.orientation_ratio},
               {"isotropic_ratio", chance.mean},
               {"isotropic_ratio_deviation", chance.standard_deviation},
               {"two_point", two_point_json(quality.two_point)},
               {"overlaps", quality.overlaps},
               {"smallest_gap", quality.smallest_gap},
               {"time_correlation", decorrelation_json(quality.decorrelation)},
               {"collisions", quality.collisions},
               {"wall_seconds", quality.wall_seconds}};
  if (quality.first_orientation_tensor)
    json["first_orientation_tensor"] = tensor_json(*quality.first_orientation_tensor);
  if (quality.backbone) json.update(backbone_json(quality.backbone));
  return json;
}

void write_quality(const std::filesystem::path& file, const PackingQuality& quality) {
  write_text(file, json_text(quality_json(quality), 1) + "\n");
}

}  // namespace vitrel
