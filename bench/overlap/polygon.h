#pragma once

#include <vector>

#include "bench/overlap/overlap_case.h"

namespace vitrel::bench {

/// The vertices of a regular polygon with the area of the unit circle: its corners lie outside, the
/// middles of its sides inside, so ellipses replaced by its images err to both sides, by about
/// 3/n² of their size. The number of vertices is even.
class RegularPolygon {
 public:
  explicit RegularPolygon(int vertices);

  /// One of every two opposite vertices.
  const std::vector<Vec2>& half() const { return half_; }

 private:
  std::vector<Vec2> half_;
};

/// Replaces both ellipses by images of the polygon and looks for a separating axis among the normals
/// of all sides: two convex polygons are disjoint iff one of these separates them. The time grows
/// as the square of the number of vertices.
bool disjoint(const RegularPolygon& shape, const OverlapCase<2>& asked);

}  // namespace vitrel::bench
