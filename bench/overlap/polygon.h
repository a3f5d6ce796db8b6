#pragma once

#include <vector>

#include "bench/overlap/overlap_case.h"

namespace vitrel::bench {

/// The vertices of a regular polygon with the area of the unit circle. Its corners lie outside the circle and the
/// middles of its sides inside, so ellipses that are replaced by its images err in both directions, by about 3/n² of
/// their size. The number n of vertices is even.
class RegularPolygon {
 public:
  explicit RegularPolygon(int vertices);

  /// One vertex of every pair of opposite ones.
  const std::vector<Vec2>& half() const { return half_; }

 private:
  std::vector<Vec2> half_;
};

/// Replaces both ellipses by images of the polygon and looks for a separating axis among the normals of all sides:
/// two convex polygons are disjoint if and only if one of these separates them. The time grows as the square of the
/// number of vertices.
bool disjoint(const RegularPolygon& shape, const OverlapCase<2>& asked);

}  // namespace vitrel::bench
