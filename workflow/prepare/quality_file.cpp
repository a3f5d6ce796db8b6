#include "workflow/prepare/quality_file.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/io/json.h"
#include "core/io/text_file.h"
#include "workflow/prepare/backbone_report.h"

namespace vitrel {
namespace {

using From = Quality::PressureFrom;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr const char* source_names[] = {"nothing", "sampling", "growth"};

const char* name_of(From from) {
  return source_names[static_cast<int>(from)];
}

From source_of(const std::string& name) {
  return name == name_of(From::growth)     ? From::growth
         : name == name_of(From::sampling) ? From::sampling
                                           : From::nothing;
}

/// A limit, or how far was looked for it in vain.
Json limit(bool reached, Json value) {
  return {{"value", std::move(value)}, {"reached", reached}};
}

Json sweeps_limit(const std::optional<std::uint64_t>& sweeps, std::uint64_t measured) {
  return limit(sweeps.has_value(), sweeps.value_or(measured));
}

std::optional<std::uint64_t> sweeps_of(const Json& limit) {
  if (!limit.at("reached").get<bool>()) return std::nullopt;
  return limit.at("value").get<std::uint64_t>();
}

Json correlation_json(const NematicCorrelation& g) {
  if (g.distance.empty()) return nullptr;
  const double length = correlation_length(g);
  const bool reached = std::isfinite(length);
  return {{"length", limit(reached, reached ? length : g.distance.front() + g.distance.back())},
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
      {"reduced_pressure", decorrelation->compressibility}};
}

std::optional<Decorrelation> decorrelation_from(const Json& json) {
  if (json.is_null()) return std::nullopt;
  Decorrelation decorrelation{json.at("sweeps"),
                              json.at("orientation"),
                              json.at("displacement"),
                              json.at("reduced_pressure"),
                              json.at("measured_sweeps"),
                              {},
                              {}};
  if (!json.at("orientation_lost").is_null())
    decorrelation.orientation_time = sweeps_of(json.at("orientation_lost"));
  decorrelation.displacement_time = sweeps_of(json.at("moved_by_width"));
  return decorrelation;
}

Quality quality_from(const Json& json) {
  Quality quality;
  quality.particles = json.at("particles");
  quality.rotors = json.at("rotors");
  quality.packing_fraction = json.at("packing_fraction");
  const Json& pressure = json.at("reduced_pressure");
  quality.pressure_from = source_of(pressure.at("from"));
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

void write_quality(const std::filesystem::path& file, const Quality& quality) {
  write_text(file, json_text(quality_json(quality), 1) + "\n");
}

Quality read_quality(const std::filesystem::path& file, const Configuration2& state) {
  if (!std::filesystem::exists(file))
    throw FileError(
        fmt::format("{}: is missing; vitrel prepare writes this quality report beside a state, and "
                    "the page needs both (that of a run needs two frames or more)",
                    file.string()));
  Quality quality;
  try {
    quality = quality_from(read_json(file));
  } catch (const Json::exception& error) {
    throw FileError(fmt::format("{}: is not a quality report of vitrel prepare: {}", file.string(),
                                error.what()));
  }
  if (quality.particles != state.size() || quality.packing_fraction != packing_fraction(state) ||
      quality.nematic_order != nematic_order(state))
    throw FileError(
        fmt::format("{}: is the quality report of another state; vitrel prepare writes "
                    "both files together",
                    file.string()));
  return quality;
}

}  // namespace vitrel
