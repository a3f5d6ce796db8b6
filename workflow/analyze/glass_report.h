#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/glass/glass_study.h"
#include "core/io/json.h"

/// @file
/// Glass runs and glass studies in words and as JSON.
namespace vitrel {

/// Rows of provenance: what keeps orientations from relaxing, why runs stay out of the fits, which law has no φ_c or
/// one with which the diffusion disagrees, and remarks.
std::vector<std::pair<std::string, std::string>> glass_notes(const GlassStudy& study);
/// Times, order and verdict of one run.
Json glass_summary(const GlassRun& run);
/// The study as JSON: `fits` has φ_c of every kind and law, or why there is none, and `remarks` says whether order or
/// glass keeps orientations and what else must be known.
Json glass_summary(const GlassStudy& study);
/// The study as text: packing fractions with order, verdict and relaxation times, and φ_c by each law.
std::string glass_text(const GlassStudy& study);

}  // namespace vitrel
