#pragma once

#include <optional>
#include <string>

/// @file
/// Numbers with a unit in text: "2 kN/m", "1140 kg/m^3", "1e-4 s".
namespace vitrel {

/// Returns the number in `unit`, for example 2000 for "2 kN/m" in "N/m"; nothing if the text is not a number followed
/// by a unit that converts to `unit`. Units are those of the library UDUNITS-2. Throws UserError if its list of units
/// is missing.
std::optional<double> quantity(const std::string& text, const std::string& unit);

/// Returns the text of a number in that unit; `quantity` reads back the bit-identical number.
std::string quantity_text(double number, const std::string& unit);

}  // namespace vitrel
