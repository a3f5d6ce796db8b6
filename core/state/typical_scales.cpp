#include "core/state/typical_scales.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/elementary.h"

namespace vitrel {
namespace {

/// value(i) of the median particle, in single precision: semi-axes are rounded, but particles of size 1 have the size 1.
double lower_median(std::size_t count, auto&& value) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(value(i));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((count - 1) / 2);
  std::ranges::nth_element(values, middle);
  return static_cast<float>(*middle);
}

}  // namespace

double size_of(const Ellipse& shape) {
  return std::sqrt(shape.a * shape.b);
}
double size_of(const Ellipsoid& shape) {
  return root(prod(shape.semi_axes), 3);
}

template <int Dim>
double typical_length(const Configuration<Dim>& c) {
  return lower_median(c.size(), [&](std::size_t i) { return size_of(c.shape[i]); });
}

template <int Dim>
double typical_time(const Configuration<Dim>& c) {
  return lower_median(c.size(),
                      [&](std::size_t i) { return std::sqrt(c.mass[i]) * size_of(c.shape[i]); });
}

template double typical_length(const Configuration2&);
template double typical_length(const Configuration3&);
template double typical_time(const Configuration2&);
template double typical_time(const Configuration3&);

}  // namespace vitrel
