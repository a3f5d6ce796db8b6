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
/// How good a prepared state is, and the file beside the state that says so.
namespace vitrel {

struct StateQuality {
  std::size_t particles = 0, rotors = 0;  ///< rotors: those that are not round
  double packing_fraction = 0;

  enum class PressureFrom { nothing, sampling, growth };
  PressureFrom pressure_from = PressureFrom::nothing;
  Estimate reduced_pressure{};  ///< βP/ρ; NaN from nothing. That of a growth has no error

  std::size_t overlaps = 0;
  double smallest_gap = 0;  ///< infinity beyond the longest semi-axis

  std::optional<JammedBackbone> backbone;      ///< from min_jammed_pressure on
  std::optional<Decorrelation> decorrelation;  ///< none if no sweeps were asked for
};

/// In the plane.
struct Quality : StateQuality {
  double nematic_order = 0;
  NematicCorrelation nematic_correlation;
  HexaticOrder hexatic_order{};
};

/// In space.
struct PackingQuality : StateQuality {
  Mat3 orientation_tensor = Mat3::Zero();        ///< 0 if all bodies are round
  std::optional<Mat3> first_orientation_tensor;  ///< before the particles moved; none if not known
  double orientation_ratio = 0;  ///< ρ = λ_max/λ_min; NaN if all bodies are round
  TwoPointStatistics two_point;
  std::uint64_t collisions = 0;  ///< of all stages; 0 if not known
  double wall_seconds = 0;       ///< 0 if not known
};

/// @name Of a complete preparation
/// The state stays as it is. The pressure is that of a short sampling on a copy; without one, or if the last stage was
/// a growth that ended jammed (min_jammed_pressure), that of the growth. Nothing if the run control asked to stop.
/// @{
std::optional<Quality> measure_quality(const Preparation<2>& preparation,
                                       const Parameters& parameters, const RunControl& control,
                                       int threads = 1);
std::optional<PackingQuality> measure_quality(const Preparation<3>& preparation,
                                              const Parameters& parameters,
                                              const RunControl& control, int threads = 1);
/// @}
/// The quality of a packing, from it and its exact check, without what only a preparation knows: the first
/// orientations, pressure, backbone, decorrelation, collisions and wall time.
PackingQuality measure_quality(const Configuration3& packing, const ExactCheck<3>& check);

/// The properties that are known, in words and rounded numbers.
std::vector<QualityRow> quality_rows(const Quality& quality);
std::vector<QualityRow> quality_rows(const PackingQuality& quality);

/// state.h5 → state.quality.json
std::filesystem::path quality_file(const std::filesystem::path& state);

/// JSON has neither NaN nor infinity: null stands for both. A limit that was not met within what
/// was looked at is told by "reached": false, and the value is how far that was.
Json quality_json(const Quality& quality);
Json quality_json(const PackingQuality& quality);

/// Written whole or not at all. Throws FileError.
void write_quality(const std::filesystem::path& file, const auto& quality) {
  write_text(file, json_text(quality_json(quality), 1) + "\n");
}

/// What write_quality wrote. FileError if there is no such file, or if it is not of this state.
Quality read_quality(const std::filesystem::path& file, const Configuration2& state);
/// Adds what only a preparation knows, from what write_quality wrote. FileError if that is no report of the same
/// packing.
void add_preparation(PackingQuality& quality, const std::filesystem::path& file);

}  // namespace vitrel
