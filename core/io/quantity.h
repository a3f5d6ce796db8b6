#pragma once

#include <optional>
#include <string>

/// @file
/// Numbers with a unit in text: "2 kN/m", "1140 kg/m^3", "1e-4 s".
namespace vitrel {

/// The number in `unit`, for example 2000 for "2 kN/m" in "N/m". Nothing if the text is not a number
/// and a unit behind it, or the unit is none of that kind. Units as the library UDUNITS-2 knows them.
/// Throws UserError if its list of units is missing.
std::optional<double> quantity(const std::string& text, const std::string& unit);

/// The text of a number in that unit; `quantity` reads back the bit-identical number.
std::string quantity_text(double number, const std::string& unit);

}  // namespace vitrel
