#include "analysis/dynamics/bessel_j0.h"

namespace vitrel {

BesselJ0::BesselJ0() {
  const auto intervals = static_cast<int>(nodes_per_unit * table_end);
  for (int k = 0; k <= intervals; ++k) {
    const double x = k / nodes_per_unit;
    nodes_.push_back({::j0(x), -::j1(x) / nodes_per_unit});
  }
}

}  // namespace vitrel
