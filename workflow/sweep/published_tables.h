#pragma once

#include <vector>

#include "analysis/results.h"
#include "workflow/sweep/seed_averages.h"
#include "workflow/sweep/study_axes.h"

/// @file
/// Tables that compare a sweep with what publications say ([[sweep.published]]).
namespace vitrel {

/// Returns those of the following two tables that have rows. `published` has a row for every value that a publication
/// gives: the keys of the sweep, the quantity, the source, the published value, and the average of the jobs.
/// `published_exponents` has a row for every power law quantity ∝ abscissaⁿ: the quantity, the source, the range of
/// the abscissa in which the law holds, the published n, and the slope of a least-squares line through the logarithms
/// of the averages in that range, which is unknown if there are fewer than two of them.
std::vector<Table> published_tables(const std::vector<SeedAverage>& averages,
                                    const std::vector<StudyAxis>& axes);

}  // namespace vitrel
