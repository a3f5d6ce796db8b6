#include "core/io/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace vitrel {

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, "\u202f");
  return digits;
}

double half_last_digit(double number) {
  std::array<char, 32> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::scientific);
  const std::string_view shortest(text.data(), static_cast<std::size_t>(end.ptr - text.data()));
  const std::string_view mantissa = shortest.substr(0, shortest.find('e'));
  const auto digits = static_cast<int>(
      std::ranges::count_if(mantissa, [](char c) { return c >= '0' && c <= '9'; }));
  const int exponent = number == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(number))));
  return 0.5 * std::pow(10, exponent + 1 - std::max(3, digits));
}

bool is_rounding(double error, double value) {
  return error <= 1e-12 * std::abs(value);
}

std::string with_error(double value, double error) {
  if (!std::isfinite(value)) return "–";
  if (!std::isfinite(error)) return fmt::format("{:.4g}", value);
  if (is_rounding(error, value)) return fmt::format("{:.6g}", value);
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(error))));
  // Rounding 0.0996 to two digits gives 0.10, which has one decimal less.
  const bool carries = std::round(error * std::pow(10, decimals)) >= 100;
  const int shown = std::max(0, decimals - (carries ? 1 : 0));
  return fmt::format("{:.{}f} ± {:.{}f}", value, shown, error, shown);
}

}  // namespace vitrel
