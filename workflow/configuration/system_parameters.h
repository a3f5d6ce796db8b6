#pragma once

#include <cstdint>

namespace vitrel {

struct SystemParameters {
  int dimension = 2;
  std::int64_t particles = 1000;
  double packing_fraction = 0.5;
  std::uint64_t seed = 1;
  double box_aspect = 1;
};

}  // namespace vitrel
