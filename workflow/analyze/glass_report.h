#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/glass/glass_study.h"
#include "core/io/json.h"

/// @file
/// Glass runs and glass studies in words and as JSON.
namespace vitrel {

/// As provenance: why runs stay out of the fits, why a law has no φ_c, or none with which the diffusion agrees.
std::vector<std::pair<std::string, std::string>> glass_notes(const GlassStudy& study);
/// Times, order and verdict of one run.
Json glass_summary(const GlassRun& run);
/// `fits`: φ_c of every kind and law, or why there is none; `remarks`: order or glass, and what else must be known.
Json glass_summary(const GlassStudy& study);
/// As text: densities with order, verdict and times, and φ_c by the laws.
std::string glass_text(const GlassStudy& study);

}  // namespace vitrel
