#include "analysis/structure/voronoi.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/neighbors/spatial_order.h"

namespace vitrel {

namespace {

/// A corner of a convex polygon about the origin, with the neighbour beyond the edge that begins there.
struct Corner {
  Vec2 at;
  Vec2 to;
  std::size_t neighbor;
};
using Polygon = std::vector<Corner>;

/// Returns the box about point i; images of i itself lie beyond its sides.
Polygon rectangle(const Vec2& lengths, std::size_t i) {
  const double x = 0.5 * lengths.x(), y = 0.5 * lengths.y();
  return {{{-x, -y}, {0, -2 * y}, i},
          {{x, -y}, {2 * x, 0}, i},
          {{x, y}, {0, 2 * y}, i},
          {{-x, y}, {-2 * x, 0}, i}};
}

/// Writes the part of a polygon that is nearer to the origin than to this neighbour into `left`. Returns false if that
/// is all of it.
bool cut(const Polygon& corners, const Vec2& to, std::size_t neighbor, Polygon& left) {
  const double half = 0.5 * to.squaredNorm();
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
    left.push_back(a <= 0 ? Corner{crossing, to, neighbor}
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

/// Points of the cell are within half a box length of its centre along each side. Each therefore has the nearest image
/// of another centre within a whole box length of the centre, so two images along each side suffice.
std::vector<Voronoi::Point> Voronoi::all_others(std::size_t place) const {
  std::vector<Point> others;
  for (std::size_t k = 0; k < order_.size(); ++k) {
    if (k == place) continue;
    Vec2 d = centres_[k] - centres_[place];
    for (int along = 0; along < 2; ++along) d[along] = std::remainder(d[along], lengths_[along]);
    for (const double x : {d.x(), d.x() - std::copysign(lengths_.x(), d.x())})
      for (const double y : {d.y(), d.y() - std::copysign(lengths_.y(), d.y())})
        others.push_back({{x, y}, x * x + y * y, order_[k]});
  }
  return others;
}

std::vector<Voronoi::Point> Voronoi::others_within(double reach, std::size_t place) const {
  // In a long and narrow box there are more images within the reach than can matter.
  const double count = static_cast<double>(order_.size());
  const double images = count * std::numbers::pi * reach * reach / lengths_.prod();
  const double boxes = (1 + 2 * reach / lengths_.array()).prod();
  if (images + boxes > 4 * count) return all_others(place);
  std::vector<Point> others;
  centres_.for_each_near(centres_[place], reach,
                         [&](std::size_t k, const Shift<2>&, const Vec2& d) {
                           // The nearest own images are the sides of the box; the other own images cut off nothing.
                           if (k != place) others.push_back({d, d.squaredNorm(), order_[k]});
                         });
  return others;
}

VoronoiCell Voronoi::cell(std::size_t i) const {
  const std::size_t place = place_[i];
  Polygon corners, left;
  std::vector<Point> near;
  double squared = 0;
  for (double reach = 0, next = reach_; reach < next; next = 2 * std::sqrt(squared)) {
    corners = rectangle(lengths_, i);
    squared = squared_farthest(corners);
    near = others_within(reach = next, place);
    std::ranges::sort(near, {}, &Point::squared);
    for (const Point& point : near) {
      if (point.squared >= 4 * squared) break;
      if (!cut(corners, point.at, point.number, left)) continue;
      corners.swap(left);
      squared = squared_farthest(corners);
    }
  }
  return as_cell(corners);
}

}  // namespace vitrel
