#pragma once

#include <optional>
#include <vector>

#include "analysis/structure/order.h"
#include "workflow/prepare/state_quality.h"

/// @file
/// How good a prepared state of the plane is.
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

}  // namespace vitrel
