#include "core/io/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vitrel {

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, "\u202f");
  return digits;
}

bool is_rounding(double error, double value) {
  return error <= 1e-12 * std::abs(value);
}

std::string with_error(double value, double error) {
  if (!std::isfinite(value)) return "–";
  if (!std::isfinite(error)) return fmt::format("{:.4g}", value);
  if (is_rounding(error, value)) return fmt::format("{:.6g}", value);
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(error))));
  // Rounding 0.0996 to two digits gives 0.10: one decimal less.
  const bool carries = std::round(error * std::pow(10, decimals)) >= 100;
  const int shown = std::max(0, decimals - (carries ? 1 : 0));
  return fmt::format("{:.{}f} ± {:.{}f}", value, shown, error, shown);
}

}  // namespace vitrel
