#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace vitrel {

struct SpeciesNameConflict {
  std::size_t species;    ///< the later one of two
  std::string complaint;  ///< completes "its name …"
};

/// Tables and columns of results are called after species (identifier, results.h). Two species that
/// would share them, or one that would take those of something else, are a conflict.
std::optional<SpeciesNameConflict> species_name_conflict(const std::vector<std::string>& names);

}  // namespace vitrel
