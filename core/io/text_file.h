#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/io/json.h"

namespace vitrel {

/// The whole file. Throws FileError.
std::string read_text(const std::filesystem::path& path);

/// Writes beside the file, then renames: readers never see half of it. Throws FileError.
void write_text(const std::filesystem::path& path, std::string_view text);

/// Throws FileError, too, if the file is not JSON.
Json read_json(const std::filesystem::path& path);

/// Makes the folder and those around it, as far as they are missing. Throws FileError.
void make_folder(const std::filesystem::path& folder);

}  // namespace vitrel
