#pragma once

#include <string>

#include "core/io/foreign/foreign_frame.h"
#include "core/state/configuration.h"
#include "workflow/analyze/analyze.h"
#include "workflow/report/report_page.h"
#include "workflow/sweep/sweep_results.h"

namespace vitrel {

/// Describes equal particles as "ellipses, κ = 2" or "ellipsoids, 5 : 1 : 1", and several species as "spheres of
/// species A, B" if all are round, else as "particles of species A, B".
template <int Dim>
std::string particles_text(const Configuration<Dim>& state);

/// The data of the report of a run, or of the jobs of a sweep in their order. Reads the files again for the movies. A
/// single run has all the room for movies (MovieLimits). Of several runs, six that are spread evenly over them share
/// half of it, and the others show their final state. `known` describes a file of another program.
ReportData report_data(const AnalysedRun& run, const KnownSystem& known = {});
ReportData report_data(const AnalysedSweep& sweep);

}  // namespace vitrel
