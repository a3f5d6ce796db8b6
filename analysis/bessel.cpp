#include "analysis/bessel.h"

#include <math.h>  // j0, j1

#include <cmath>
#include <numbers>

namespace vitrel {

BesselJ0::BesselJ0() {
  for (double k = 0; k <= nodes; ++k) {
    const double x = k / nodes_per_unit;
    table_.push_back({::j0(x), -::j1(x) / nodes_per_unit});
  }
}

double BesselJ0::far(double x) {
  const double y = 1 / (x * x);
  const double p = 1 + y * (-9.0 / 128 + y * 3675.0 / 32768);
  const double q = (-1.0 / 8 + y * 75.0 / 1024) / x;
  const double phase = x - std::numbers::pi / 4;
  return std::sqrt(2 / (std::numbers::pi * x)) * (p * std::cos(phase) - q * std::sin(phase));
}

}  // namespace vitrel
