#include "bench/programs/number_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace vitrel::bench {

std::string count_text(std::uint64_t count) {
  return count == 0 ? "·" : std::to_string(count);
}

std::string time_text(double nanoseconds) {
  static constexpr std::array<const char*, 4> units = {"ns", "µs", "ms", "s"};
  double value = nanoseconds;
  std::size_t unit = 0;
  while (value >= 999.5 && unit + 1 < units.size()) value /= 1000, ++unit;
  return fmt::format("{:.{}f} {}", value, value < 9.995 ? 2 : value < 99.95 ? 1 : 0, units[unit]);
}

std::string error_text(double error) {
  if (std::isnan(error)) return "–";
  return error == 0 ? "0" : fmt::format("{:.1e}", error);
}

std::string ratio_text(double ratio) {
  return ratio < 999.5 ? fmt::format("{:.3g}", ratio) : fmt::format("{:.0f}", ratio);
}

}  // namespace vitrel::bench
