#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/blocking.h"
#include "analysis/structure/contacts.h"
#include "analysis/structure/order.h"
#include "analysis/structure/orientation_tensor.h"
#include "analysis/structure/two_point.h"
#include "core/io/json.h"
#include "core/io/text_file.h"
#include "core/state/stage.h"
#include "mc/decorrelation.h"
#include "workflow/prepare/prepare.h"
#include "workflow/prepare/quality_row.h"

/// @file
/// The quality of a prepared state, and the file beside the state that reports it.
namespace vitrel {

struct StateQuality {
  std::size_t particles = 0, rotors = 0;  ///< rotors are the particles that are not round
  double packing_fraction = 0;

  enum class PressureFrom { nothing, sampling, growth };
  PressureFrom pressure_from = PressureFrom::nothing;
  /// βP/ρ; NaN if it was not measured. It has no error if it comes from growth.
  Estimate reduced_pressure{};

  std::size_t overlaps = 0;
  double smallest_gap = 0;  ///< infinity beyond the longest semi-axis

  std::optional<JammedBackbone> backbone;      ///< from a Z of min_jammed_pressure on
  std::optional<Decorrelation> decorrelation;  ///< none if the parameters request no sweeps
};

/// The quality of a state in the plane.
struct Quality : StateQuality {
  double nematic_order = 0;
  NematicCorrelation nematic_correlation;
  HexaticOrder hexatic_order{};
};

/// The quality of a state in space.
struct PackingQuality : StateQuality {
  Mat3 orientation_tensor = Mat3::Zero();  ///< 0 if all bodies are round
  /// The orientation tensor before the particles moved; none if it is not known.
  std::optional<Mat3> first_orientation_tensor;
  double orientation_ratio = 0;  ///< ρ = λ_max/λ_min; NaN if all bodies are round
  TwoPointStatistics two_point;
  std::uint64_t collisions = 0;  ///< in all stages; 0 if not known
  double wall_seconds = 0;       ///< 0 if not known
};

/// @name Quality of a complete preparation
/// The state does not change: the pressure is measured by a short sampling of a copy. If there is no sampling, or if
/// the last stage was a growth that ended jammed (min_jammed_pressure), the pressure is that of the growth. The
/// result is empty if the run control requested a stop.
/// @{
std::optional<Quality> measure_quality(const Preparation<2>& preparation,
                                       const Parameters& parameters, const RunControl& control,
                                       int threads = 1);
std::optional<PackingQuality> measure_quality(const Preparation<3>& preparation,
                                              const Parameters& parameters,
                                              const RunControl& control, int threads = 1);
/// @}
/// The quality of a packing from its configuration and its exact check. It lacks what only a preparation knows: the
/// first orientations, pressure, backbone, decorrelation, collisions and wall time.
PackingQuality measure_quality(const Configuration3& packing, const ExactCheck<3>& check);

/// The known properties in words and rounded numbers.
std::vector<QualityRow> quality_rows(const Quality& quality);
std::vector<QualityRow> quality_rows(const PackingQuality& quality);

/// The file of the quality report of a state: state.quality.json for state.h5.
std::filesystem::path quality_file(const std::filesystem::path& state);

/// JSON has neither NaN nor infinity, so null stands for both. If a quantity did not reach its limit within the range
/// measured, "reached" is false and the value is the end of that range.
Json quality_json(const Quality& quality);
Json quality_json(const PackingQuality& quality);

/// Writes the file whole or not at all. Throws FileError.
void write_quality(const std::filesystem::path& file, const auto& quality) {
  write_text(file, json_text(quality_json(quality), 1) + "\n");
}

/// Reads what write_quality wrote. Throws FileError if there is no such file, or if it belongs to another state.
Quality read_quality(const std::filesystem::path& file, const Configuration2& state);
/// Adds what only a preparation knows from the report that write_quality wrote. Throws FileError if that is no report
/// of this packing.
void add_preparation(PackingQuality& quality, const std::filesystem::path& file);

}  // namespace vitrel
