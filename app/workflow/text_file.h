#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vitrel {

/// The whole file. Throws FileError.
std::string read_text(const std::filesystem::path& path);

/// Writes beside the file, then renames: readers never see half of it. Throws FileError.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace vitrel
