#pragma once

#include <filesystem>

#include "core/io/json.h"
#include "workflow/prepare/quality.h"

/// @file
/// The quality of a state on file, beside the state itself.
namespace vitrel {

/// state.h5 → state.quality.json
std::filesystem::path quality_file(const std::filesystem::path& state);

/// JSON has neither NaN nor infinity: null stands for both. A limit that was not met within what
/// was looked at is told by "reached": false, and the value is how far that was.
Json quality_json(const Quality& quality);

/// Written whole or not at all. Throws FileError.
void write_quality(const std::filesystem::path& file, const Quality& quality);

/// What write_quality wrote. FileError if there is no such file, or if it is not of this state.
Quality read_quality(const std::filesystem::path& file, const Configuration2& state);

}  // namespace vitrel
