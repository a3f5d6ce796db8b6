#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "workflow/prepare/quality_row.h"

namespace vitrel {

/// The names and texts of everything that says how a page was made.
using PageProvenance = std::vector<std::pair<std::string, std::string>>;

/// Escapes text so that it stands for itself in HTML and XML.
std::string escaped(std::string_view text);

/// A cell of a table. The text must be HTML.
std::string table_cell(const std::string& text);

/// The entries of a description list. Entries without text are left out.
std::string provenance_entries(const PageProvenance& provenance);

/// The rows of a table of properties.
std::string table_rows(const std::vector<QualityRow>& rows);

}  // namespace vitrel
