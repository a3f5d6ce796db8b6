#pragma once

#include <string>
#include <vector>

#include "core/io/foreign/foreign_frame.h"
#include "core/state/configuration.h"
#include "workflow/analyze/analyze.h"
#include "workflow/report/report_page.h"

namespace vitrel {

/// "ellipses, κ = 2" or "ellipsoids, 5 : 1 : 1" for equal particles; of several species "spheres of species
/// A, B" if all are round, else "particles of species A, B".
template <int Dim>
std::string particles_text(const Configuration<Dim>& state);

/// The report's view of these runs, in their order: one run, or jobs of one sweep. Reads the files again, for
/// the movies: one run has all the room for movies (MovieLimits); of several, six spread evenly over them share half of it, and the
/// others show their final state.
/// `known`: of files of other programs.
ReportData report_data(const std::vector<AnalysedRun>& runs, const KnownSystem& known = {});

}  // namespace vitrel
