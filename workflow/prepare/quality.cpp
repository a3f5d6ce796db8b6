#include "workflow/prepare/quality.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/io/text_file.h"
#include "core/special_values.h"

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
  read_json_as("a quality report", file,
               [&](const Json& report) { quality = quality_from(report); });
  // Other versions and libraries round the last digits otherwise.
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

}  // namespace vitrel
