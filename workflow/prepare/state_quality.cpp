#include "workflow/prepare/state_quality.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/io/number_text.h"
#include "core/special_values.h"

namespace vitrel {
namespace {

using From = StateQuality::PressureFrom;

constexpr const char* source_names[] = {"nothing", "sampling", "growth"};

QualityRow decay_row(const std::string& name, const std::optional<std::uint64_t>& sweeps,
                     std::uint64_t measured, const std::string& remark) {
  return {
      name,
      sweeps ? fmt::format("{} sweeps", *sweeps) : fmt::format("longer than {} sweeps", measured),
      remark};
}

/// `grown` is 0 if the last stage was no growth, or too short a one to measure the pressure.
void note_pressure(StateQuality& quality, double grown) {
  if (quality.decorrelation && grown < min_jammed_pressure) {
    quality.pressure_from = From::sampling;
    quality.reduced_pressure = slow_average(quality.decorrelation->compressibility);
    const double bias = quality.decorrelation->compressibility_bias;
    double& error = quality.reduced_pressure.error;
    error = std::sqrt(error * error + bias * bias);
  } else if (grown > 0) {
    quality.pressure_from = From::growth;
    quality.reduced_pressure = {grown, unknown, 0};
  } else {
    quality.reduced_pressure = {unknown, unknown, 0};
  }
}

std::string pressure_remark(const StateQuality& quality) {
  if (quality.pressure_from == From::growth) return "at the end of the growth";
  if (quality.pressure_from == From::nothing) return "not measured";
  return std::isfinite(quality.reduced_pressure.error)
             ? "Monte Carlo sampling"
             : "Monte Carlo sampling, too short for an error";
}

Json sweeps_limit(const std::optional<std::uint64_t>& sweeps, std::uint64_t measured) {
  return limit_json(sweeps.has_value(), sweeps.value_or(measured));
}

std::optional<std::uint64_t> sweeps_of(const Json& limit) {
  if (!limit.at("reached").get<bool>()) return std::nullopt;
  return limit.at("value").get<std::uint64_t>();
}

}  // namespace

template <int Dim>
bool measure_state(StateQuality& quality, const Preparation<Dim>& preparation,
                   const Parameters& parameters, const RunControl& control, int threads) {
  const Configuration<Dim>& state = preparation.configuration;
  if (parameters.quality_sweeps > 0) {
    quality.decorrelation =
        measure_decorrelation(state, parameters.quality_sweeps, parameters.system.seed,
                              preparation.next_sweep, control, threads);
    if (!quality.decorrelation) return false;
  }
  quality.particles = state.size();
  quality.rotors = rotor_count(state);
  quality.packing_fraction = packing_fraction(state);
  note_pressure(quality, preparation.stages.back().growth.reduced_pressure);
  quality.overlaps = preparation.check.overlaps.size();
  quality.smallest_gap = preparation.check.smallest_gap;
  if (const double pressure = quality.reduced_pressure.mean; pressure >= min_jammed_pressure)
    quality.backbone = jammed_backbone(state, pressure);
  return true;
}

template bool measure_state(StateQuality&, const Preparation<2>&, const Parameters&,
                            const RunControl&, int);
template bool measure_state(StateQuality&, const Preparation<3>&, const Parameters&,
                            const RunControl&, int);

QualityRow packing_fraction_row(const StateQuality& quality) {
  return {"packing fraction φ", fmt::format("{:.6g}", quality.packing_fraction), ""};
}

QualityRow pressure_row(const StateQuality& quality) {
  return {"reduced pressure βP/ρ",
          with_error(quality.reduced_pressure.mean, quality.reduced_pressure.error),
          pressure_remark(quality)};
}

QualityRow gap_row(const StateQuality& quality) {
  return {"smallest gap",
          std::isfinite(quality.smallest_gap) ? fmt::format("{:.3g}", quality.smallest_gap)
                                              : "beyond the longest semi-axis",
          fmt::format("exact check: {} overlaps", quality.overlaps)};
}

/// Disks and spheres are rigid only with as many contacts as they have degrees of freedom, less those of the whole, and one
/// more against the pressure: D (N' − 1) + 1 between the N' that are held.
std::string rigidity_remark(const StateQuality& quality, const JammedBackbone& backbone) {
  const std::size_t held = quality.particles - backbone.rattlers;
  if (quality.rotors > 0 || held == 0) return "";
  const auto dimension = static_cast<std::size_t>(backbone.isostatic_number / 2);
  const std::size_t least = dimension * (held - 1) + 1;
  if (backbone.contacts >= least) return "";
  return fmt::format(
      "; not rigid: there are {} contacts, but at least {} are needed; grow more slowly",
      backbone.contacts, least);
}

void add_backbone_rows(std::vector<QualityRow>& rows, const StateQuality& quality) {
  if (!quality.backbone) return;
  const JammedBackbone& backbone = *quality.backbone;
  const bool jammed = std::isfinite(backbone.contact_number);
  rows.push_back({"contacts per particle",
                  jammed ? fmt::format("{:.3f}", backbone.contact_number) : "–",
                  jammed ? fmt::format("without rattlers; isostatic: {:.3g}; gaps below {:.2g}",
                                       backbone.isostatic_number, backbone.tolerance) +
                               rigidity_remark(quality, backbone)
                         : "not jammed"});
  rows.push_back({"rattlers", fmt::format("{} of {}", backbone.rattlers, quality.particles),
                  "particles that their contacts do not hold"});
}

void add_time_rows(std::vector<QualityRow>& rows, const StateQuality& quality,
                   const std::string& correlation) {
  if (!quality.decorrelation) return;
  const Decorrelation& decorrelation = *quality.decorrelation;
  if (quality.rotors > 0)
    rows.push_back(decay_row("orientation time", decorrelation.orientation_time,
                             decorrelation.measured, fmt::format("until {} < 1/e", correlation)));
  rows.push_back(decay_row("displacement time", decorrelation.displacement_time,
                           decorrelation.measured,
                           "until the particles have moved by their width"));
}

Json limit_json(bool reached, Json value) {
  return {{"value", std::move(value)}, {"reached", reached}};
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

}  // namespace vitrel
