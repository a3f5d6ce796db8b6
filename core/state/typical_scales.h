#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// The typical length and the typical time of the particles, to which options can be relative. Both are medians over
/// the particles (the lower of the two middle values if their number is even), so that a few large particles among many
/// small ones do not change them.
namespace vitrel {

namespace detail {

/// Returns the median of value(i), rounded to single precision: semi-axes are rounded, but particles of size 1 must
/// give exactly 1.
double lower_median(std::size_t count, const auto& value) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(value(i));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((count - 1) / 2);
  std::ranges::nth_element(values, middle);
  return static_cast<float>(*middle);
}

}  // namespace detail

/// The median size of a particle.
template <int Dim>
double typical_length(const Configuration<Dim>& c) {
  return detail::lower_median(c.size(), [&](std::size_t i) { return c.shape[i].size(); });
}

/// The time τ in which a particle moves by about its own size: the median of √(m a b/kT), or of √(m/kT) ∛(a b c) in
/// three dimensions, at kT = 1.
template <int Dim>
double typical_time(const Configuration<Dim>& c) {
  return detail::lower_median(
      c.size(), [&](std::size_t i) { return std::sqrt(c.mass[i]) * c.shape[i].size(); });
}

}  // namespace vitrel
