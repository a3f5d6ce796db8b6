#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// The size of a particle, and the length and the time that are typical of all of them, so that options can be relative
/// to these: medians over the particles, of an even number the lower one. A few large particles among many small ones
/// leave both as they are.
namespace vitrel {

namespace detail {

/// value(i) of the median particle, in single precision: semi-axes are rounded, but particles of size 1 have the size
/// 1.
double lower_median(std::size_t count, const auto& value) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(value(i));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((count - 1) / 2);
  std::ranges::nth_element(values, middle);
  return static_cast<float>(*middle);
}

}  // namespace detail

/// The median size.
template <int Dim>
double typical_length(const Configuration<Dim>& c) {
  return detail::lower_median(c.size(), [&](std::size_t i) { return c.shape[i].size(); });
}

/// τ, in which a particle moves by about its own size: of √(m a b/kT), or √(m/kT) ∛(a b c), at kT = 1.
template <int Dim>
double typical_time(const Configuration<Dim>& c) {
  return detail::lower_median(
      c.size(), [&](std::size_t i) { return std::sqrt(c.mass[i]) * c.shape[i].size(); });
}

}  // namespace vitrel
