#pragma once

#include "bench/methods/method.h"

namespace vitrel::bench {

/// The first root of F(t) − 1, F the function of Perram and Wertheim: a scan of the bracket in steps of
/// `tolerance` times its length (usual 1/100), and algorithm 748 within the first step that ends with
/// F ≤ 1. An overlap between two steps is missed.
Prediction3 perram_wertheim_root(const EllipsoidCase& asked, double tolerance);

/// Every method for ellipsoids at its usual tolerance, the default first.
std::vector<MethodOf<3>> ellipsoid_methods();

/// Every one at a series of tolerances, from coarse to fine.
std::vector<MethodOf<3>> ellipsoid_methods_by_tolerance();

}  // namespace vitrel::bench
