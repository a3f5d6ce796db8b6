#pragma once

#include <filesystem>

#include "workflow/analyze/analyze.h"
#include "workflow/report/state_page.h"

namespace vitrel {

/// What the page of a prepared state of the plane shows, from the file of the state and the quality report beside it.
/// Throws FileError.
/// `known`: of files of other programs.
StatePage state_page_data(const std::filesystem::path& file, const KnownSystem& known = {});

/// What the page of a packing on file shows: the bodies (of more than 10 000 those in the middle), their
/// exact check, quality and structure. The quality report of vitrel prepare, if there is one beside the file,
/// adds what only the preparation knows. Throws FileError or UserError, naming the file.
StatePage packing_page_data(const std::filesystem::path& file, const AnalysisChoice& choice,
                            const AnalysisProgress& progress = {});

}  // namespace vitrel
