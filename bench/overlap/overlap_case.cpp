#include "bench/overlap/overlap_case.h"

#include <cmath>
#include <numbers>

#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/perram_wertheim.h"
#include "core/random/stream.h"

namespace vitrel::bench {
namespace {

using Kind = OverlapClass::Kind;
using Real = long double;

// The centres are put as far apart as the rounding of coordinates next to 1 allows to tell.
OverlapCase at_distance(const OverlapCase& from, const Vec2& way, double distance) {
  OverlapCase moved = from;
  moved.pose2.position = moved.pose1.position + distance * way;
  return moved;
}

double drawn_gap(Kind kind, Stream& draw) {
  const double sign = draw.uniform() < 0.5 ? -1 : 1;
  return sign *
         (kind == Kind::grazing ? std::pow(10, draw.uniform(-12, -3)) : 0.1 * draw.uniform());
}

Real support(const EllipseAxes<Real>& e, Real nx, Real ny) {
  const Real along = e.a * (nx * e.cosine + ny * e.sine);
  const Real across = e.b * (ny * e.cosine - nx * e.sine);
  return std::sqrt(along * along + across * across);
}

EllipseAxes<Real> axes(const Ellipse& ellipse, double angle) {
  return {ellipse.a, ellipse.b, std::cos(static_cast<Real>(angle)),
          std::sin(static_cast<Real>(angle))};
}

}  // namespace

std::vector<OverlapClass> overlap_classes() {
  std::vector<OverlapClass> classes;
  for (const double aspect_ratio : {2.0, 6.0}) {
    classes.push_back({Kind::random, "random",
                       "centres anywhere within a₁ + a₂, crossed and contained pairs included",
                       aspect_ratio});
    classes.push_back({Kind::near_contact, "near_contact", "a gap of up to ±0.1 b", aspect_ratio});
    classes.push_back({Kind::grazing, "grazing", "a gap of ±10⁻³ … ±10⁻¹² b", aspect_ratio});
  }
  return classes;
}

OverlapCase make_overlap_case(const OverlapClass& of, std::uint64_t seed, std::uint64_t index) {
  const auto stream_of_class = 1000 + static_cast<std::uint64_t>(of.kind);
  Stream draw(seed, Purpose::benchmark_cases, stream_of_class, index);
  const double root = std::sqrt(of.aspect_ratio), size = draw.uniform(1, 2);
  const double turn = 2 * std::numbers::pi;
  OverlapCase asked{{root, 1 / root},
                    {size * root, size / root},
                    {{0, 0}, draw.uniform(0, turn)},
                    {{0, 0}, draw.uniform(0, turn)}};
  const double angle = draw.uniform(0, turn);
  const Vec2 way(std::cos(angle), std::sin(angle));
  const double reach = asked.one.a + asked.two.a;
  if (of.kind == Kind::random) return at_distance(asked, way, reach * std::sqrt(draw.uniform()));
  const PerramWertheim<2> touching =
      perram_wertheim(asked.one, asked.pose1.angle, asked.two, asked.pose2.angle, way);
  const double gap = drawn_gap(of.kind, draw) * asked.gap_unit();
  // Along the line of centres the gap grows by n·way per unit of distance.
  return at_distance(asked, way, 1 / std::sqrt(touching.value) + gap / touching.normal.dot(way));
}

OverlapTruth true_overlap(const OverlapCase& asked) {
  const EllipseAxes<Real> one = axes(asked.one, asked.pose1.angle);
  const EllipseAxes<Real> two = axes(asked.two, asked.pose2.angle);
  const Vec2 d = asked.between_centres();
  const Vec2 n =
      perram_wertheim(asked.one, asked.pose1.angle, asked.two, asked.pose2.angle, d).normal;
  const Real nx = n.x(), ny = n.y(), length = std::hypot(nx, ny);
  const Real gap = (nx * d.x() + ny * d.y()) / length - support(one, nx / length, ny / length) -
                   support(two, nx / length, ny / length);
  return {vieillard_baron<Real>(one, two, d.x(), d.y()).disjoint_or_touching(),
          static_cast<double>(gap)};
}

}  // namespace vitrel::bench
