#include "bench/overlap/polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrel::bench {
namespace {

// A centrally symmetric polygon is determined by its centre and by half of its vertices, given relative to the
// centre.
using HalfPolygon = std::vector<Vec2>;

HalfPolygon image(const RegularPolygon& shape, const Ellipse& ellipse, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  HalfPolygon polygon;
  polygon.reserve(shape.half().size());
  for (const Vec2& vertex : shape.half()) {
    const double x = ellipse.a * vertex.x(), y = ellipse.b * vertex.y();
    polygon.emplace_back(cosine * x - sine * y, sine * x + cosine * y);
  }
  return polygon;
}

double extent(const HalfPolygon& polygon, const Vec2& axis) {
  double largest = 0;
  for (const Vec2& vertex : polygon) largest = std::max(largest, std::abs(axis.dot(vertex)));
  return largest;
}

bool some_side_separates(const HalfPolygon& sides, const HalfPolygon& one, const HalfPolygon& two,
                         const Vec2& d) {
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Vec2 next = k + 1 < sides.size() ? sides[k + 1] : Vec2(-sides[0]);
    const Vec2 axis = perpendicular(next - sides[k]);
    if (std::abs(axis.dot(d)) > extent(one, axis) + extent(two, axis)) return true;
  }
  return false;
}

}  // namespace

RegularPolygon::RegularPolygon(int vertices) {
  const double step = 2 * std::numbers::pi / vertices;
  const double radius = std::sqrt(step / std::sin(step));
  for (int k = 0; k < vertices / 2; ++k)
    half_.emplace_back(radius * std::cos(k * step), radius * std::sin(k * step));
}

bool disjoint(const RegularPolygon& shape, const OverlapCase<2>& asked) {
  const HalfPolygon one = image(shape, asked.one, asked.pose1.angle);
  const HalfPolygon two = image(shape, asked.two, asked.pose2.angle);
  const Vec2 d = asked.between_centres();
  return some_side_separates(one, one, two, d) || some_side_separates(two, one, two, d);
}

}  // namespace vitrel::bench
