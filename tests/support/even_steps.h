#pragma once

#include <vector>

namespace vitrel {

inline std::vector<double> even_steps(double from, double step, std::size_t count) {
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) values.push_back(from + step * static_cast<double>(k));
  return values;
}

}  // namespace vitrel
