#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/io/json.h"

namespace vitrel {

/// Returns the whole file as text. Throws FileError.
std::string read_text(const std::filesystem::path& path);

/// Writes a partial file and renames it, so that readers never see half of it. Throws FileError.
void write_text(const std::filesystem::path& path, std::string_view text);

/// Reads a file of JSON. Throws FileError, too, if it is not JSON.
Json read_json(const std::filesystem::path& path);

/// Passes the JSON of a file to `read`. Throws FileError, which names the file, if it is not JSON, or is not `what`: if
/// it lacks a member that `read` requires, or has one of another type.
void read_json_as(const std::string& what, const std::filesystem::path& file,
                  const std::function<void(const Json&)>& read);

/// Throws FileError for a pipe or a device, whose end nobody knows.
void require_regular_file(const std::filesystem::path& file);

/// Makes the folder and its parent folders where they are missing. Throws FileError.
void make_folder(const std::filesystem::path& folder);

}  // namespace vitrel
