#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/geometry/vector.h"
#include "core/whole_number.h"

namespace vitrel {

/// A position in a file may be at most this many boxes away from the box, and a particle may have crossed the box at
/// most this often. The sum of both numbers then fits into 32 bits.
inline constexpr double max_box_crossings = 1e9;

/// Returns the box crossings that a file states; nothing if one is not a whole number or is impossible.
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
