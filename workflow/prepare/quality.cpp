#include "workflow/prepare/quality.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/number_text.h"
#include "core/parallel.h"
#include "core/special_values.h"

namespace vitrel {
namespace {

using From = StateQuality::PressureFrom;

QualityRow decay_row(const std::string& name, const std::optional<std::uint64_t>& sweeps,
                     std::uint64_t measured, const std::string& remark) {
  return {
      name,
      sweeps ? fmt::format("{} sweeps", *sweeps) : fmt::format("longer than {} sweeps", measured),
      remark};
}

/// `grown` is the reduced pressure at the end of the last stage; 0 if that was no growth, or too short to measure it.
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

/// Returns false if the run control requested a stop.
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

/// Disks and spheres can be rigid only if there are as many contacts as degrees of freedom, less the D translations
/// of the whole, and one more for the pressure: D (N' − 1) + 1 contacts between the N' particles that are not
/// rattlers.
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

/// Bin width of the nematic correlation in units of √⟨ab⟩.
constexpr double bin_width = 0.25;

double unit_length(const Configuration2& configuration) {
  double areas = 0;
  for (const ParticleShape<2>& shape : configuration.shape) areas += shape.natural_mass();
  return std::sqrt(areas / static_cast<double>(configuration.size()));
}

void add_nematic_rows(std::vector<QualityRow>& rows, const Quality& quality) {
  if (quality.rotors == 0) return;
  const double noise = nematic_order_by_chance(quality.rotors, 2);
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

std::string components(const Mat3& tensor) {
  // Adding 0.0 turns −0, which is left of a rounding error, into 0.
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
  quality.hexatic_order = hexatic_order(state, all_cores);
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

}  // namespace vitrel
