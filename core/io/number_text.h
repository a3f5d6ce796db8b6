#pragma once

#include <cstdint>
#include <string>

/// @file
/// Numbers as people read them.
namespace vitrel {

/// 1234567 with thin spaces between groups of three digits.
std::string grouped(std::uint64_t number);

/// Half a unit of the last digit of the shortest text that reads back as this number, of which three digits count at
/// least: 5e-7 of 0.898242, 5e-4 of 0.5.
double half_last_digit(double number);

/// Whether the error of an average says no more than that numbers that should be equal are so up to rounding:
/// at most 1e-12 of the value.
bool is_rounding(double error, double value);

/// "1.234 ± 0.012": the error with two significant digits, the value with as many decimals. Without
/// a finite error the value has four significant digits, with one that is rounding six; "–" if it is not
/// finite either.
std::string with_error(double value, double error);

}  // namespace vitrel
