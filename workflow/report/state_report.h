#pragma once

#include <filesystem>

#include "workflow/report/state_page.h"

namespace vitrel {

/// What the page of a prepared state shows, from the file of the state and the quality report beside it.
/// Throws FileError.
StatePage state_page_data(const std::filesystem::path& file);

}  // namespace vitrel
