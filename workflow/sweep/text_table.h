#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vitrel {

/// What stands in a cell without a value.
inline constexpr const char* missing_cell = "–";

/// Rows of cells, the titles first, as columns of equal width, without those that are empty but for their title; the
/// first `texts` columns are flush left, the others right.
std::string text_table(const std::vector<std::vector<std::string>>& rows, std::size_t texts);

}  // namespace vitrel
