#pragma once

#include <string>

#include "core/io/foreign/foreign_frame.h"
#include "core/state/configuration.h"
#include "workflow/analyze/analyze.h"
#include "workflow/report/report_page.h"
#include "workflow/sweep/sweep_results.h"

namespace vitrel {

/// "ellipses, κ = 2" or "ellipsoids, 5 : 1 : 1" for equal particles; of several species "spheres of species
/// A, B" if all are round, else "particles of species A, B".
template <int Dim>
std::string particles_text(const Configuration<Dim>& state);

/// The report's view of a run, or of the jobs of a sweep in their order. Reads the files again, for the movies: one run has
/// all the room for movies (MovieLimits); of several, six spread evenly over them share half of it, and the others show
/// their final state. `known`: of a file of another program.
ReportData report_data(const AnalysedRun& run, const KnownSystem& known = {});
ReportData report_data(const AnalysedSweep& sweep);

}  // namespace vitrel
