#include "analysis/structure/voronoi.h"

#include <algorithm>
#include <cmath>

#include "core/neighbors/spatial_order.h"

namespace vitrel {

namespace {

/// A corner of a convex polygon about the origin, and the neighbour beyond the edge that begins
/// there.
struct Corner {
  Vec2 at;
  Vec2 to;
  std::size_t neighbor;
};
using Polygon = std::vector<Corner>;

/// Beyond the sides are images of the point i itself.
Polygon rectangle(const Vec2& lengths, std::size_t i) {
  const double x = 0.5 * lengths.x(), y = 0.5 * lengths.y();
  return {{{-x, -y}, {0, -2 * y}, i},
          {{x, -y}, {2 * x, 0}, i},
          {{x, y}, {0, 2 * y}, i},
          {{-x, y}, {-2 * x, 0}, i}};
}

/// Another point, seen from the centre of a cell.
struct Point {
  Vec2 at;
  double squared;  ///< distance
  std::size_t number;
};

/// What of a polygon is nearer to the origin than to this point, into `left`. False if that is all of it.
bool cut(const Polygon& corners, const Point& point, Polygon& left) {
  const Vec2& to = point.at;
  const double half = 0.5 * point.squared;
  const auto excess = [&](const Corner& corner) { return corner.at.dot(to) - half; };
  if (std::ranges::all_of(corners, [&](const Corner& corner) { return excess(corner) <= 0; }))
    return false;
  left.clear();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Corner& here = corners[k];
    const Corner& next = corners[k + 1 < corners.size() ? k + 1 : 0];
    const double a = excess(here), b = excess(next);
    if (a <= 0) left.push_back(here);
    if ((a <= 0) == (b <= 0)) continue;
    const Vec2 crossing = here.at + a / (a - b) * (next.at - here.at);
    left.push_back(a <= 0 ? Corner{crossing, to, point.number}
                          : Corner{crossing, here.to, here.neighbor});
  }
  return true;
}

double squared_farthest(const Polygon& corners) {
  double squared = 0;
  for (const Corner& corner : corners) squared = std::max(squared, corner.at.squaredNorm());
  return squared;
}

VoronoiCell as_cell(const Polygon& corners) {
  VoronoiCell cell{0, {}};
  cell.edges.reserve(corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2& here = corners[k].at;
    const Vec2& next = corners[(k + 1) % corners.size()].at;
    cell.area += 0.5 * cross(here, next);
    cell.edges.push_back({corners[k].to, (next - here).norm(), corners[k].neighbor});
  }
  return cell;
}

}  // namespace

Voronoi::Voronoi(const Configuration2& configuration)
    : lengths_(configuration.box.lengths()),
      order_(spatial_order<2>(configuration.box, configuration.position)),
      place_(order_.size()),
      reach_(2.2 *
             std::sqrt(configuration.box.volume() / static_cast<double>(configuration.size()))),
      centres_(configuration.box, reach_, configuration.size()) {
  for (std::uint32_t k = 0; k < order_.size(); ++k) {
    place_[order_[k]] = k;
    centres_.insert(k, configuration.position[order_[k]]);
  }
}

VoronoiCell Voronoi::cell(std::size_t i) const {
  const std::size_t place = place_[i];
  Polygon corners, left;
  std::vector<Point> near;
  double squared = 0;
  for (double reach = 0, next = reach_; reach < next; next = 2 * std::sqrt(squared)) {
    corners = rectangle(lengths_, i);
    squared = squared_farthest(corners);
    near.clear();
    centres_.for_each_near(centres_[place], reach = next,
                           [&](std::size_t k, const Shift<2>& shift, const Vec2& d) {
                             // The four nearest own images are the sides of the box.
                             if (k != place || shift.squaredNorm() > 1)
                               near.push_back({d, d.squaredNorm(), order_[k]});
                           });
    std::ranges::sort(near, {}, &Point::squared);
    for (const Point& point : near) {
      if (point.squared >= 4 * squared) break;
      if (!cut(corners, point, left)) continue;
      corners.swap(left);
      squared = squared_farthest(corners);
    }
  }
  return as_cell(corners);
}

}  // namespace vitrel
