#pragma once

#include <cstddef>
#include <vector>

#include "analysis/results.h"
#include "analysis/structure/pair_correlation.h"
#include "analysis/structure/structure_factor.h"
#include "analysis/structure/structure_options.h"
#include "analysis/trajectory.h"
#include "core/parallel.h"

/// @file
/// The structure of a run, averaged over its frames.
namespace vitrel {

/// The tables structure_factor, pair_correlation, orientation_distribution (unless all particles are
/// round) and order. Errors are those of averages over frames (frame_average.h). Frames are read
/// one after another and measured on up to `threads` threads, some at a time; the results do not
/// depend on it. `report` is called with the share of the frames that are done.
std::vector<Table> structure_tables(Trajectory& trajectory, const StructureOptions& options,
                                    int threads = all_cores, const ProgressReport& report = {});

}  // namespace vitrel
