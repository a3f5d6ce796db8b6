#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "analysis/structure/order.h"
#include "core/io/json.h"
#include "workflow/prepare/state_quality.h"

/// @file
/// How good a prepared state of the plane is, and the file beside the state that says so.
namespace vitrel {

struct Quality : StateQuality {
  double nematic_order = 0;
  NematicCorrelation nematic_correlation;
  HexaticOrder hexatic_order{};
};

/// Of a complete preparation (measure_state). Nothing if the run control asked to stop.
std::optional<Quality> measure_quality(const Preparation<2>& preparation,
                                       const Parameters& parameters, const RunControl& control,
                                       int threads = 1);

/// The properties, in words and rounded numbers.
std::vector<QualityRow> quality_rows(const Quality& quality);

/// state.h5 → state.quality.json
std::filesystem::path quality_file(const std::filesystem::path& state);

/// JSON has neither NaN nor infinity: null stands for both. A limit that was not met within what
/// was looked at is told by "reached": false, and the value is how far that was.
Json quality_json(const Quality& quality);

/// Written whole or not at all. Throws FileError.
void write_quality(const std::filesystem::path& file, const Quality& quality);

/// What write_quality wrote. FileError if there is no such file, or if it is not of this state.
Quality read_quality(const std::filesystem::path& file, const Configuration2& state);

}  // namespace vitrel
