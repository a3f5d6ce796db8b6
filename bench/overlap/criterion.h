#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/overlap/overlap_case.h"

namespace vitrel::bench {

/// A way to tell whether two ellipses are disjoint.
struct OverlapCriterion {
  std::string name;  ///< "vieillard_baron"
  std::string meaning;
  int vertices = 0;  ///< of the polygons, if there are any
  std::function<bool(const OverlapCase&)> disjoint;
};

/// All of them, the one the program uses first; polygons with 8, 16 … 256 vertices last. Every one
/// is asked with positions and angles, so the sines and cosines are in its time.
std::vector<OverlapCriterion> overlap_criteria();

}  // namespace vitrel::bench
