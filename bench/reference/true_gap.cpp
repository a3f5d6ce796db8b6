#include "bench/reference/true_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace vitrel::bench {

namespace {

using Real = long double;

struct Support {
  Real height;     // h
  Real slope;      // dh/dφ
  Real curvature;  // the radius of curvature ρ
};

class Shape {
 public:
  Shape(const Flight<GrowingEllipse>& flight, Real time) {
    const Real size = flight.body.size + Real(flight.body.growth_rate) * time;
    const Real angle = flight.pose.angle + Real(flight.motion.angular_velocity) * time;
    a_ = size * flight.body.shape.a;
    b_ = size * flight.body.shape.b;
    bulge_ = (a_ - b_) * (a_ + b_);
    cos_ = std::cos(angle);
    sin_ = std::sin(angle);
  }

  Support support(Real nx, Real ny) const {
    const Real c = nx * cos_ + ny * sin_, s = ny * cos_ - nx * sin_;
    const Real h = std::hypot(a_ * c, b_ * s);
    if (h == 0) return {0, 0, 0};
    return {h, -bulge_ * c * s / h, (a_ / h) * (b_ / h) * a_ * (b_ / h)};
  }
  // The smallest radius of curvature within w of where the support is h.
  Real min_curvature(Real h, Real w) const {
    if (a_ == 0) return 0;
    const Real highest = std::min(a_, h + (a_ - b_) * w);
    return (a_ / highest) * (b_ / highest) * a_ * (b_ / highest);
  }
  Real a() const { return a_; }
  Real max_support_rate() const { return a_ - b_; }

 private:
  Real a_ = 0, b_ = 0, bulge_ = 0, cos_ = 1, sin_ = 0;
};

class GapOverDirections {
 public:
  GapOverDirections(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two, Real time)
      : one_(one, time), two_(two, time) {
    const auto along = [&](int k) {
      return (Real(two.pose.position[k]) - one.pose.position[k]) +
             (Real(two.motion.velocity[k]) - one.motion.velocity[k]) * time;
    };
    x_ = along(0);
    y_ = along(1);
    distance_ = std::hypot(x_, y_);
    steepest_ = distance_ + one_.max_support_rate() + two_.max_support_rate();
    reach_ = distance_ + one_.a() + two_.a();
  }

  struct Point {
    Real angle;
    Real gap, slope;
    Support one, two;
  };
  Point at(Real angle) const {
    const Real nx = std::cos(angle), ny = std::sin(angle);
    const Support h1 = one_.support(nx, ny), h2 = two_.support(nx, ny);
    return {angle, nx * x_ + ny * y_ - h1.height - h2.height,
            nx * y_ - ny * x_ - h1.slope - h2.slope, h1, h2};
  }

  Point maximum() const {
    constexpr int pieces = 8;
    const Real half = std::numbers::pi_v<Real> / pieces;
    const Real towards = std::atan2(y_, x_);
    std::vector<Piece> left;
    for (int k = 0; k < pieces; ++k) left.push_back({at(towards + 2 * half * k), half});
    Point best = left.front().middle;
    while (!left.empty()) {
      const auto next = std::max_element(
          left.begin(), left.end(), [](auto& p, auto& q) { return p.middle.gap < q.middle.gap; });
      const Piece piece = *next;
      *next = left.back();
      left.pop_back();
      if (piece.middle.gap > best.gap) best = piece.middle;
      const Real most = highest(piece);
      if (most <= best.gap) continue;
      if (is_concave(piece)) {
        const Point peak = climbed(piece);
        if (peak.gap >= best.gap) best = peak;
        continue;
      }
      if (piece.half < (most > 0 ? 1e-12L : 1e-3L)) continue;
      const Real quarter = piece.half / 2;
      left.push_back({at(piece.middle.angle - quarter), quarter});
      left.push_back({at(piece.middle.angle + quarter), quarter});
    }
    return settled(best);
  }

 private:
  struct Piece {
    Point middle;
    Real half;
  };

  Real highest(const Piece& piece) const {
    return piece.middle.gap + std::abs(piece.middle.slope) * piece.half +
           reach_ * piece.half * piece.half / 2;
  }

  bool is_concave(const Piece& piece) const {
    const Point& m = piece.middle;
    return m.gap - steepest_ * piece.half + one_.min_curvature(m.one.height, piece.half) +
               two_.min_curvature(m.two.height, piece.half) >
           0;
  }

  // The zero of the slope, which falls from `low` to `high`; an end if it has none.
  Point climbed(const Piece& piece) const {
    Real low = piece.middle.angle - piece.half, high = piece.middle.angle + piece.half;
    const Point first = at(low), last = at(high);
    if (first.slope <= 0) return first;
    if (last.slope >= 0) return last;
    Point here = piece.middle;
    while (true) {
      (here.slope > 0 ? low : high) = here.angle;
      const Real curvature = here.gap + here.one.curvature + here.two.curvature;
      Real next = here.angle + here.slope / curvature;
      if (!(next > low && next < high)) next = (low + high) / 2;
      const bool settled = std::abs(next - here.angle) <= 4 * std::numeric_limits<Real>::epsilon();
      if (settled || next <= low || next >= high) return here;
      here = at(next);
    }
  }

  // Points near the maximum have its gap to within rounding; only the slope tells them apart.
  Point settled(const Point& best) const {
    constexpr Real flat = 1e-8L;
    const Real curvature = best.gap + best.one.curvature + best.two.curvature;
    const bool is_near = curvature > 0 && std::abs(best.slope) < flat * curvature;
    return is_near ? at(best.angle + best.slope / curvature) : best;
  }

  Shape one_, two_;
  Real x_ = 0, y_ = 0;
  Real distance_ = 0, steepest_ = 0, reach_ = 0;
};

}  // namespace

ClosestSurfaces closest_surfaces(const Flight<GrowingEllipse>& one,
                                 const Flight<GrowingEllipse>& two, long double time) {
  const auto peak = GapOverDirections(one, two, time).maximum();
  const Real nx = std::cos(peak.angle), ny = std::sin(peak.angle);
  const auto relative = [&](int k) {
    return Real(two.motion.velocity[k]) - one.motion.velocity[k];
  };
  // How fast each body's support advances: by growth, and by turning (∂h/∂θ = −∂h/∂φ).
  const auto advance = [&](const Flight<GrowingEllipse>& flight, const Support& h) {
    Flight<GrowingEllipse> at_size_1 = flight;
    at_size_1.body.size = 1;
    at_size_1.body.growth_rate = 0;
    return flight.body.growth_rate * Shape(at_size_1, time).support(nx, ny).height -
           flight.motion.angular_velocity * h.slope;
  };
  return {peak.gap,
          {static_cast<double>(nx), static_cast<double>(ny)},
          advance(one, peak.one) + advance(two, peak.two) - nx * relative(0) - ny * relative(1)};
}

long double true_gap(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two,
                     long double time) {
  return GapOverDirections(one, two, time).maximum().gap;
}

}  // namespace vitrel::bench
