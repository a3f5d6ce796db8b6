#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <optional>

namespace vitrel {

/// The whole number that x is, if the type can represent it. The language leaves open what a conversion makes of other
/// numbers: infinity, NaN, and those that are too large.
template <std::integral Integer>
std::optional<Integer> whole_number(double x) {
  using Limits = std::numeric_limits<Integer>;
  // The largest number may be none of double precision; the one after it is a power of two.
  constexpr double end = 2 * static_cast<double>(Limits::max() / 2 + 1);
  if (!(x >= static_cast<double>(Limits::min()) && x < end) || x != std::floor(x)) return {};
  return static_cast<Integer>(x);
}

}  // namespace vitrel
