#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/glass/glass_study.h"
#include "analysis/results.h"

/// @file
/// Glass runs and glass studies as tables of results.
namespace vitrel {

/// Adds a judged run to its results: a table `relaxation` of one row, and the reasons of its verdicts in the
/// provenance.
void store_glass_run(const GlassRun& run, Results& results);
/// Reads the judged run back from its results, with everything that a study needs; no value if the results have none.
/// Throws FileError for results of another version.
std::optional<GlassRun> stored_glass_run(const std::string& name, const Results& results);

/// Tables `relaxation` (one row per run), `glass_fit` (one row per kind and law) and `glass_fit_windows` (one row per
/// kind, law and window). Kinds, laws and verdicts are coded as numbers, which the descriptions of the columns
/// explain.
std::vector<Table> glass_tables(const GlassStudy& study);

}  // namespace vitrel
