#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/io/text_file.h"
#include "core/special_values.h"
#include "workflow/prepare/quality.h"

namespace vitrel {
namespace {

using From = StateQuality::PressureFrom;

constexpr const char* source_names[] = {"nothing", "sampling", "growth"};

Json limit_json(bool reached, Json value) {
  return {{"value", std::move(value)}, {"reached", reached}};
}

Json sweeps_limit(const std::optional<std::uint64_t>& sweeps, std::uint64_t measured) {
  return limit_json(sweeps.has_value(), sweeps.value_or(measured));
}

std::optional<std::uint64_t> sweeps_of(const Json& limit) {
  if (!limit.at("reached").get<bool>()) return std::nullopt;
  return limit.at("value").get<std::uint64_t>();
}

const char* name_of(From from) {
  return source_names[static_cast<int>(from)];
}

From pressure_source(const std::string& name) {
  return name == name_of(From::growth)     ? From::growth
         : name == name_of(From::sampling) ? From::sampling
                                           : From::nothing;
}

Json backbone_json(const std::optional<JammedBackbone>& backbone) {
  if (!backbone) return nullptr;
  return {{"contact_tolerance", backbone->tolerance},
          {"contact_number", backbone->contact_number},
          {"isostatic_number", backbone->isostatic_number},
          {"contacts", backbone->contacts},
          {"rattlers", backbone->rattlers}};
}

std::optional<JammedBackbone> backbone_from(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return JammedBackbone{
      {json.at("rattlers"), json.at("contacts"), number_or(json.at("contact_number"), unknown),
       number_or(json.at("isostatic_number"), unknown)},
      json.at("contact_tolerance")};
}

Json decorrelation_json(const std::optional<Decorrelation>& decorrelation) {
  if (!decorrelation) return nullptr;
  const bool has_rotors = !decorrelation->orientation.empty();
  return {
      {"orientation_lost",
       has_rotors ? sweeps_limit(decorrelation->orientation_time, decorrelation->measured)
                  : Json(nullptr)},
      {"moved_by_width", sweeps_limit(decorrelation->displacement_time, decorrelation->measured)},
      {"measured_sweeps", decorrelation->measured},
      {"sweeps", decorrelation->sweeps},
      {"orientation", decorrelation->orientation},
      {"displacement", decorrelation->displacement},
      {"reduced_pressure", decorrelation->compressibility},
      {"reduced_pressure_bias", decorrelation->compressibility_bias}};
}

std::optional<Decorrelation> decorrelation_from(const Json& json) {
  if (json.is_null()) return std::nullopt;
  Decorrelation decorrelation{json.at("sweeps"),
                              json.at("orientation"),
                              json.at("displacement"),
                              json.at("reduced_pressure"),
                              json.value("reduced_pressure_bias", 0.0),
                              json.at("measured_sweeps"),
                              {},
                              {}};
  if (!json.at("orientation_lost").is_null())
    decorrelation.orientation_time = sweeps_of(json.at("orientation_lost"));
  decorrelation.displacement_time = sweeps_of(json.at("moved_by_width"));
  return decorrelation;
}

Json correlation_json(const NematicCorrelation& g) {
  if (g.distance.empty()) return nullptr;
  const double length = correlation_length(g);
  const bool reached = std::isfinite(length);
  return {
      {"length", limit_json(reached, reached ? length : g.distance.front() + g.distance.back())},
      {"distance", g.distance},
      {"value", g.value},
      {"pairs", g.pairs}};
}

NematicCorrelation correlation_from(const Json& json) {
  if (json.is_null()) return {};
  NematicCorrelation g{json.at("distance"), {}, json.at("pairs")};
  for (const Json& value : json.at("value")) g.value.push_back(number_or(value, unknown));
  return g;
}

Quality quality_from(const Json& json) {
  Quality quality;
  quality.particles = json.at("particles");
  quality.rotors = json.at("rotors");
  quality.packing_fraction = json.at("packing_fraction");
  const Json& pressure = json.at("reduced_pressure");
  quality.pressure_from = pressure_source(pressure.at("from"));
  quality.reduced_pressure = {number_or(pressure.at("value"), unknown),
                              number_or(pressure.at("error"), unknown), 0};
  quality.nematic_order = json.at("nematic_order");
  quality.nematic_correlation = correlation_from(json.at("nematic_correlation"));
  quality.hexatic_order = {json.at("hexatic_order").at("global"),
                           json.at("hexatic_order").at("local")};
  quality.overlaps = json.at("overlaps");
  quality.smallest_gap = number_or(json.at("smallest_gap"), infinity);
  quality.backbone = backbone_from(json.at("jamming"));
  quality.decorrelation = decorrelation_from(json.at("time_correlation"));
  return quality;
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

/// Fields that reports of earlier versions lack become unknown. The pressure of such a report is that of a growth.
void read_pressure(PackingQuality& quality, const Json& report) {
  quality.reduced_pressure = {
      number_or(report.at("reduced_pressure"), unknown),
      number_or(report.value("reduced_pressure_error", Json(nullptr)), unknown), 0};
  const bool known = std::isfinite(quality.reduced_pressure.mean);
  quality.pressure_from =
      pressure_source(report.value("reduced_pressure_from", known ? "growth" : "nothing"));
}

}  // namespace

std::filesystem::path quality_file(const std::filesystem::path& state) {
  return std::filesystem::path(state).replace_extension("quality.json");
}

Json quality_json(const Quality& quality) {
  const Estimate& pressure = quality.reduced_pressure;
  return {{"particles", quality.particles},
          {"rotors", quality.rotors},
          {"packing_fraction", quality.packing_fraction},
          {"reduced_pressure",
           {{"value", pressure.mean},
            {"error", pressure.error},
            {"from", name_of(quality.pressure_from)}}},
          {"nematic_order", quality.nematic_order},
          {"nematic_correlation", correlation_json(quality.nematic_correlation)},
          {"hexatic_order",
           {{"global", quality.hexatic_order.global}, {"local", quality.hexatic_order.local}}},
          {"overlaps", quality.overlaps},
          {"smallest_gap", quality.smallest_gap},
          {"jamming", backbone_json(quality.backbone)},
          {"time_correlation", decorrelation_json(quality.decorrelation)}};
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

Quality read_quality(const std::filesystem::path& file, const Configuration2& state) {
  if (!std::filesystem::exists(file))
    throw FileError(
        fmt::format("{}: is missing; vitrel prepare writes this quality report beside a state, and "
                    "the page needs both (that of a run needs two frames or more)",
                    file.string()));
  Quality quality;
  read_json_as("a quality report", file,
               [&](const Json& report) { quality = quality_from(report); });
  // Other versions and libraries may round the last digits differently.
  const auto differ = [](double one, double two) { return !(std::abs(one - two) <= 1e-12); };
  if (quality.particles != state.size() ||
      differ(quality.packing_fraction, packing_fraction(state)) ||
      differ(quality.nematic_order, nematic_order(state)))
    throw FileError(
        fmt::format("{}: is the quality report of another state; vitrel prepare writes "
                    "both files together",
                    file.string()));
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

}  // namespace vitrel
