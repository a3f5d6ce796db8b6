#pragma once

#include <filesystem>

#include "workflow/analyze/analyze.h"
#include "workflow/report/state_page.h"

namespace vitrel {

/// The data of the page of a prepared state in the plane, from the file of the state and the quality report beside
/// it. `known` describes a file of another program. Throws FileError.
StatePage state_page_data(const std::filesystem::path& file, const KnownSystem& known = {});

/// The data of the page of a packing on file: the bodies (those in the middle if there are more than 10 000), their
/// exact check, quality and structure. If there is a quality report of vitrel prepare beside the file, it adds what
/// only the preparation knows. Throws FileError or UserError, naming the file.
StatePage packing_page_data(const std::filesystem::path& file, const AnalysisChoice& choice,
                            const AnalysisProgress& progress = {});

}  // namespace vitrel
