#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/foreign/foreign_frame.h"
#include "core/io/json.h"
#include "workflow/report/html.h"

/// @file
/// What the pages are put together from.
namespace vitrel {

/// Six significant digits are more than any pixel shows; JSON has no NaN, null stands for it.
Json page_number(double value, int digits = 6);

/// These rows of a column.
Json page_numbers(const std::vector<double>& values, const std::vector<std::size_t>& rows,
                  int digits = 6);

/// JSON or ordered JSON inside a script element: no "<" is left that could end it.
std::string script_safe(const Json& data);

/// Replaces every {{name}} of the template by its text, in one pass, so that no text is looked into.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string>>& texts);

/// How pages about particles in the plane or in space call their units: the reduced ones of vitrel, or those of a file.
struct PageUnits {
  std::string note;  ///< a sentence
  std::string length, area, time, diffusion, rotational_diffusion, energy;
};
PageUnits page_units(int dimension, const std::optional<FileUnits>& of_file = {});
/// The unit of a column in these words; empty for pure numbers.
std::string unit_name(const std::string& unit, const PageUnits& units);

/// A whole page. `sections` and `script` are names of files of the folder page; the texts fill the
/// sections, beside those that all pages have: movie and the units.
struct PageParts {
  std::string title, subtitle;
  std::string_view sections;
  std::string_view script;
  std::vector<std::pair<std::string_view, std::string>> texts;
  std::string data;        ///< for the script: script_safe JSON
  std::string parameters;  ///< TOML
  PageProvenance provenance;
  int dimension = 2;                    ///< of the picture, and of the units
  std::optional<FileUnits> units = {};  ///< of a file of another program
  std::string units_note = {};          ///< a sentence instead of that on the units
};
std::string whole_page(PageParts parts);

}  // namespace vitrel
