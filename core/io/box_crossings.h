#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/geometry/vector.h"
#include "core/whole_number.h"

namespace vitrel {

/// How many boxes away from the box a position in a file may be, and how often a particle may have crossed the box:
/// both together are whole numbers of 32 bits.
inline constexpr double max_box_crossings = 1e9;

/// Box crossings as a file has them; none if one is no whole number, or impossible.
template <int Dim>
std::optional<Shift<Dim>> box_crossings(const Vec<Dim>& numbers) {
  Shift<Dim> crossings;
  for (int k = 0; k < Dim; ++k) {
    const std::optional<std::int32_t> whole = whole_number<std::int32_t>(numbers[k]);
    if (!whole || std::abs(numbers[k]) > max_box_crossings) return {};
    crossings[k] = *whole;
  }
  return crossings;
}

}  // namespace vitrel
