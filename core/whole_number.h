#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <optional>

namespace vitrel {

/// Returns x as an integer if it is a whole number that the type can represent. The language does not define the
/// conversion of infinity, NaN and numbers that are too large.
template <std::integral Integer>
std::optional<Integer> whole_number(double x) {
  using Limits = std::numeric_limits<Integer>;
  // The largest value of the type may not be representable in double precision, but the one after it is a power of two.
  constexpr double end = 2 * static_cast<double>(Limits::max() / 2 + 1);
  if (!(x >= static_cast<double>(Limits::min()) && x < end) || x != std::floor(x)) return {};
  return static_cast<Integer>(x);
}

}  // namespace vitrel
