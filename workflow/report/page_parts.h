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
/// The parts from which pages are assembled.
namespace vitrel {

/// A number with six significant digits, which is more than any pixel shows. JSON has no NaN, so it becomes null.
Json page_number(double value, int digits = 6);

/// The numbers of a column in the given rows.
Json page_numbers(const std::vector<double>& values, const std::vector<std::size_t>& rows,
                  int digits = 6);

/// JSON for a script element. It contains no "<" that could end the element.
std::string script_safe(const Json& data);

/// Replaces every {{name}} of the template by its text in a single pass, so that the texts themselves are not
/// searched.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string>>& texts);

/// The names of units on pages about particles in the plane or in space: the reduced units of vitrel, or those of a
/// file.
struct PageUnits {
  std::string note;  ///< as a sentence
  std::string length, area, time, diffusion, rotational_diffusion, energy;
};
PageUnits page_units(int dimension, const std::optional<FileUnits>& of_file = {});
/// The name of the unit of a column; empty for pure numbers.
std::string unit_name(const std::string& unit, const PageUnits& units);

/// The parts of a whole page. `sections` and `script` name files in the folder page. `texts` fill the sections; the
/// movie and the units, which all pages have, are added to them.
struct PageParts {
  std::string title, subtitle;
  std::string_view sections;
  std::string_view script;
  std::vector<std::pair<std::string_view, std::string>> texts;
  std::string data;        ///< JSON for the script, made by script_safe
  std::string parameters;  ///< as TOML
  PageProvenance provenance;
  int dimension = 2;                    ///< determines the picture and the units
  std::optional<FileUnits> units = {};  ///< of a file of another program
  std::string units_note = {};          ///< replaces the sentence about the units
};
std::string whole_page(PageParts parts);

}  // namespace vitrel
