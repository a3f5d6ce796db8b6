#pragma once

#include <vector>

#include "analysis/results.h"
#include "workflow/sweep/seed_averages.h"
#include "workflow/sweep/study_axes.h"

/// @file
/// What publications say of a sweep ([[sweep.published]]), beside its own results.
namespace vitrel {

/// Those of two tables that have rows. `published`: for every value that a publication gives, the keys of the sweep,
/// the quantity, the source, that value and the average of the jobs. `published_exponents`: for every power law
/// quantity ∝ abscissaⁿ, the quantity, the source, the part of the abscissa in which it holds, the published n, and the
/// slope of a least-squares line through the logarithms of the averages in that part; unknown with fewer than two of
/// them.
std::vector<Table> published_tables(const std::vector<SeedAverage>& averages,
                                    const std::vector<StudyAxis>& axes);

}  // namespace vitrel
