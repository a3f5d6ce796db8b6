#pragma once

#include <cstdint>
#include <string>

/// @file
/// Numbers as text for people.
namespace vitrel {

/// Returns a number like 1234567 with thin spaces between groups of three digits.
std::string grouped(std::uint64_t number);

/// Returns half a unit of the last digit of the shortest text that reads back as this number, with at least three
/// digits: 5e-7 for 0.898242, 5e-4 for 0.5.
double half_last_digit(double number);

/// Returns whether the error of an average is only the rounding of numbers that should be equal: at most 1e-12 of the
/// value.
bool is_rounding(double error, double value);

/// Returns a text like "1.234 ± 0.012": the error has two significant digits, and the value as many decimals. Without a
/// finite error the text is the value with four significant digits, and with an error that is rounding, with six. It is
/// "–" if the value is not finite.
std::string with_error(double value, double error);

}  // namespace vitrel
