#include "bench/overlap/overlap_case.h"

#include <cmath>

#include "bench/surveys/drawn_class.h"
#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/ellipsoid_eta.h"
#include "core/contact/perram_wertheim.h"

namespace vitrel::bench {
namespace {

using Kind = OverlapClass::Kind;
using Real = long double;
using RealVec3 = Eigen::Matrix<Real, 3, 1>;

double drawn_gap(Kind kind, Stream& draw) {
  const double of_sign = sign(draw);
  return of_sign *
         (kind == Kind::grazing ? std::pow(10, draw.uniform(-12, -3)) : 0.1 * draw.uniform());
}

OverlapCase<2> pair_at_origin(Stream& draw, double kappa, std::integral_constant<int, 2>) {
  const double root = std::sqrt(kappa), size = draw.uniform(1, 2);
  const double turn = 2 * std::numbers::pi, angle1 = draw.uniform(0, turn);
  return {{root, 1 / root},
          {size * root, size / root},
          {{0, 0}, angle1},
          {{0, 0}, draw.uniform(0, turn)}};
}

OverlapCase<3> pair_at_origin(Stream& draw, double kappa, std::integral_constant<int, 3>) {
  const double size = draw.uniform(1, 2);
  const Ellipsoid one = any_shape<3>(draw, kappa), two = any_shape<3>(draw, kappa);
  const Quaternion turn1 = any_orientation<3>(draw);
  return {
      one, {size * two.semi_axes}, {Vec3::Zero(), turn1}, {Vec3::Zero(), any_orientation<3>(draw)}};
}

template <int Dim>
Vec<Dim> any_way(Stream& draw) {
  if constexpr (Dim == 3)
    return any_direction<3>(draw);
  else
    return unit(draw.uniform(0, 2 * std::numbers::pi));
}

template <int Dim>
PerramWertheim<Dim> scaled_to_touch(const OverlapCase<Dim>& asked, const Vec<Dim>& d) {
  return perram_wertheim(asked.one, orientation_of(asked.pose1), asked.two,
                         orientation_of(asked.pose2), d);
}

EllipseAxes<Real> axes(const Ellipse& ellipse, const Pose2& pose) {
  return {ellipse.a, ellipse.b, std::cos(static_cast<Real>(pose.angle)),
          std::sin(static_cast<Real>(pose.angle))};
}

Real support(const Ellipse& body, const Pose2& pose, const Eigen::Matrix<Real, 2, 1>& n) {
  const EllipseAxes<Real> e = axes(body, pose);
  const Real along = e.a * (n.x() * e.cosine + n.y() * e.sine);
  const Real across = e.b * (n.y() * e.cosine - n.x() * e.sine);
  return std::sqrt(along * along + across * across);
}

Real support(const Ellipsoid& body, const Pose3& pose, const RealVec3& n) {
  const EllipsoidAxes<Real> axes(body, pose.orientation);
  return axes.lengths.cwiseProduct(axes.directions.transpose() * n).norm();
}

bool are_disjoint(const OverlapCase<2>& asked) {
  const Vec2 d = asked.between_centres();
  return vieillard_baron<Real>(axes(asked.one, asked.pose1), axes(asked.two, asked.pose2), d.x(),
                               d.y())
      .disjoint_or_touching();
}

bool are_disjoint(const OverlapCase<3>& asked) {
  const EllipsoidAxes<Real> one(asked.one, asked.pose1.orientation),
      two(asked.two, asked.pose2.orientation);
  return ellipsoid_eta<Real>(one, two, RealVec3(asked.between_centres().cast<Real>()))
      .disjoint_or_touching();
}

}  // namespace

template <int Dim>
std::vector<OverlapClass> overlap_classes() {
  std::vector<OverlapClass> classes;
  for (const double aspect_ratio : {2., Dim == 2 ? 6. : 10.}) {
    classes.push_back({Kind::random, "random", aspect_ratio});
    classes.push_back({Kind::near_contact, "near_contact", aspect_ratio});
    classes.push_back({Kind::grazing, "grazing", aspect_ratio});
  }
  return classes;
}

template <int Dim>
OverlapCase<Dim> make_overlap_case(const OverlapClass& of, std::uint64_t seed,
                                   std::uint64_t index) {
  const auto stream_of_class = 1000 + static_cast<std::uint64_t>(of.kind);
  Stream draw(seed, Purpose::benchmark_cases, stream_of_class, index);
  OverlapCase<Dim> asked =
      pair_at_origin(draw, of.aspect_ratio, std::integral_constant<int, Dim>());
  const Vec<Dim> way = any_way<Dim>(draw);
  double distance = 0;
  if (of.kind == Kind::random) {
    distance =
        (asked.one.circumradius() + asked.two.circumradius()) * std::pow(draw.uniform(), 1. / Dim);
  } else {
    const PerramWertheim<Dim> touching = scaled_to_touch(asked, way);
    const double gap = drawn_gap(of.kind, draw) * asked.gap_unit();
    // Along the line of centres, the gap grows by n·way per unit of distance.
    distance = 1 / std::sqrt(touching.value) + gap / touching.normal.dot(way);
  }
  asked.pose2.position = asked.pose1.position + distance * way;
  return asked;
}

template <int Dim>
OverlapTruth true_overlap(const OverlapCase<Dim>& asked) {
  using RealVec = Eigen::Matrix<Real, Dim, 1>;
  const Vec<Dim> d = asked.between_centres();
  const RealVec n = RealVec(scaled_to_touch(asked, d).normal.template cast<Real>()).normalized();
  const Real gap = n.dot(d.template cast<Real>()) - support(asked.one, asked.pose1, n) -
                   support(asked.two, asked.pose2, n);
  return {are_disjoint(asked), static_cast<double>(gap)};
}

template std::vector<OverlapClass> overlap_classes<2>();
template std::vector<OverlapClass> overlap_classes<3>();
template OverlapCase<2> make_overlap_case(const OverlapClass&, std::uint64_t, std::uint64_t);
template OverlapCase<3> make_overlap_case(const OverlapClass&, std::uint64_t, std::uint64_t);
template OverlapTruth true_overlap(const OverlapCase<2>&);
template OverlapTruth true_overlap(const OverlapCase<3>&);

}  // namespace vitrel::bench
