#pragma once

#include <filesystem>

#include "core/io/foreign/foreign_frame.h"
#include "workflow/report/state_page.h"

namespace vitrel {

/// What the page of a prepared state shows, from the file of the state and the quality report beside it.
/// Throws FileError.
/// `known`: of files of other programs.
StatePage state_page_data(const std::filesystem::path& file, const KnownSystem& known = {});

}  // namespace vitrel
