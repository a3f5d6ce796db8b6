#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "analysis/structure/orientation_tensor.h"
#include "analysis/structure/two_point.h"
#include "core/io/json.h"
#include "workflow/prepare/state_quality.h"

/// @file
/// How good a prepared state of three dimensions is.
namespace vitrel {

struct PackingQuality : StateQuality {
  Mat3 orientation_tensor = Mat3::Zero();        ///< 0 if all bodies are round
  std::optional<Mat3> first_orientation_tensor;  ///< before the particles moved; none if not known
  double orientation_ratio = 0;  ///< ρ = λ_max/λ_min; NaN if all bodies are round
  TwoPointStatistics two_point;
  std::uint64_t collisions = 0;  ///< of all stages; 0 if not known
  double wall_seconds = 0;       ///< 0 if not known
};

/// Of a complete preparation (measure_state). Nothing if the run control asked to stop.
std::optional<PackingQuality> measure_quality(const Preparation<3>& preparation,
                                              const Parameters& parameters,
                                              const RunControl& control, int threads = 1);
/// Of a packing and its exact check: without what only a preparation knows, which is the first orientations, pressure,
/// backbone, decorrelation, collisions and wall time.
PackingQuality measure_quality(const Configuration3& packing, const ExactCheck<3>& check);
/// Adds these, from what write_quality wrote. FileError if that is no report of the same packing.
void add_preparation(PackingQuality& quality, const std::filesystem::path& file);

/// The properties that are known, in words and rounded numbers.
std::vector<QualityRow> quality_rows(const PackingQuality& quality);

/// JSON has neither NaN nor infinity: null stands for both.
Json quality_json(const PackingQuality& quality);

/// Written whole or not at all. Throws FileError.
void write_quality(const std::filesystem::path& file, const PackingQuality& quality);

}  // namespace vitrel
