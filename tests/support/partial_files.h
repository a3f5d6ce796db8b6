#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrel {

/// The names of what was begun and not finished (core/io/atomic_file.h), in a folder and below it.
inline std::vector<std::string> partial_files(const std::filesystem::path& folder) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".partial") found.push_back(entry.path().filename().string());
  return found;
}

}  // namespace vitrel
