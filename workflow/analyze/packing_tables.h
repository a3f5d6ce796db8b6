#pragma once

#include <vector>

#include "analysis/results.h"
#include "core/state/configuration.h"
#include "workflow/analyze/structure_tables.h"

namespace vitrel {

/// The structure of one packing of ellipsoids. Tables: summary, of one row; orientation_tensor, unless all
/// are round; structure_factor and pair_correlation, without errors, as there is only one packing.
std::vector<Table> packing_tables(const Configuration3& packing, const StructureOptions& options);

}  // namespace vitrel
