#include "core/state/exact_pair.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/elementary.h"

namespace vitrel::exact {
namespace {

using std::abs, std::sqrt;  // beside those of DoubleDouble

constexpr double longest_step = 0.1;

/// g(n) = n·d − h₁(n) − h₂(n) at a unit vector n, and the step of n along its tangent by which Newton's
/// method would go to the maximum; where g is not concave, one of the longest length uphill.
template <int Dim, class Real>
struct Separation {
  Real gap;
  Point<Dim, Real> step;
};

/// The support function of an ellipse about its centre along the unit vector n, with its derivative
/// along the angle of n and the radius of curvature ρ = h + h'' = a²b²/h³.
template <class Real>
struct EllipseSupport {
  Real h, slope, radius;
};

template <class Real>
EllipseSupport<Real> support_of(const EllipseAxes<Real>& e, const Point<2, Real>& n) {
  const Real along = n.x() * e.cosine + n.y() * e.sine;
  const Real across = n.y() * e.cosine - n.x() * e.sine;
  const Real p = e.a * along;
  const Real q = e.b * across;
  const Real h = sqrt(p * p + q * q);
  const Real ab = e.a * e.b;
  return {h, -(e.a - e.b) * (e.a + e.b) * along * across / h, ab * ab / (h * h * h)};
}

template <class Real>
Separation<2, Real> separation_along(const Particle<2, Real>& one, const Particle<2, Real>& two,
                                     const Point<2, Real>& d, const Point<2, Real>& n) {
  const EllipseSupport<Real> first = support_of(one.axes, n);
  const EllipseSupport<Real> second = support_of(two.axes, n);
  const Real gap = n.x() * d.x() + n.y() * d.y() - first.h - second.h;
  const Real slope = n.x() * d.y() - n.y() * d.x() - first.slope - second.slope;
  const Real curvature = -gap - first.radius - second.radius;
  const Real turn = curvature < 0
                        ? std::clamp<Real>(-slope / curvature, -longest_step, longest_step)
                    : slope < 0 ? -longest_step
                                : longest_step;
  return {gap, {-turn * n.y(), turn * n.x()}};
}

template <int Dim, class Real>
using Matrix = Eigen::Matrix<Real, Dim, Dim>;

/// Semi-axes as columns: Σ = AAᵀ and h = |Aᵀn|.
template <class Real>
Matrix<2, Real> semi_axes(const EllipseAxes<Real>& e) {
  Matrix<2, Real> axes;
  axes << e.a * e.cosine, -e.b * e.sine, e.a * e.sine, e.b * e.cosine;
  return axes;
}

template <class Real>
Matrix<3, Real> semi_axes(const EllipsoidAxes<Real>& e) {
  return e.directions * e.lengths.asDiagonal();
}

/// h of an ellipsoid with its gradient Σn/h and its matrix of second derivatives Σ/h − Σn(Σn)ᵀ/h³, for
/// any vector n.
template <class Real>
struct EllipsoidSupport {
  Real h;
  Point<3, Real> gradient;
  Matrix<3, Real> bend;

  EllipsoidSupport(const EllipsoidAxes<Real>& e, const Point<3, Real>& n) {
    const Matrix<3, Real> axes = semi_axes(e);
    const Point<3, Real> along = axes.transpose() * n;
    h = along.norm();
    gradient = axes * (along / h);
    bend = (axes * axes.transpose() - gradient * gradient.transpose()) / h;
  }
};

/// Two unit vectors that complete n, as columns.
template <class Real>
Eigen::Matrix<Real, 3, 2> tangents(const Point<3, Real>& n) {
  Eigen::Matrix<Real, 3, 2> t;
  t.col(0) = n.unitOrthogonal();
  t.col(1) = n.cross(t.col(0));
  return t;
}

/// The solution of m x = y for a positive definite m, by Cholesky's decomposition.
template <class Real>
Point<2, Real> solved(const Matrix<2, Real>& m, const Point<2, Real>& y) {
  const Real l00 = sqrt(m(0, 0)), l10 = m(1, 0) / l00, l11 = sqrt(m(1, 1) - l10 * l10);
  const Real z0 = y[0] / l00, z1 = (y[1] - l10 * z0) / l11, x1 = z1 / l11;
  return {(z0 - l10 * x1) / l00, x1};
}

/// On the sphere the second derivatives are those in space less g times the unit matrix, since all terms
/// of g are homogeneous in n.
template <class Real>
Separation<3, Real> separation_along(const Particle<3, Real>& one, const Particle<3, Real>& two,
                                     const Point<3, Real>& d, const Point<3, Real>& n) {
  const EllipsoidSupport<Real> first(one.axes, n);
  const EllipsoidSupport<Real> second(two.axes, n);
  const Real gap = n.dot(d) - first.h - second.h;
  const Eigen::Matrix<Real, 3, 2> t = tangents(n);
  const Point<2, Real> slope = t.transpose() * (d - first.gradient - second.gradient);
  Matrix<2, Real> bend = t.transpose() * (first.bend + second.bend) * t;
  bend.diagonal().array() += gap;
  const bool concave = bend(0, 0) > 0 && bend.determinant() > 0;
  Point<2, Real> turn = concave ? solved(bend, slope) : slope;
  const Real length = turn.norm();
  if (length > longest_step || (!concave && length > 0)) turn *= longest_step / length;
  return {gap, t * turn};
}

/// The local maximum of g above n: Newton's method, halving every step that would lead down. Where
/// g > 0 it is strictly concave on the sphere, so that there is one maximum. Ends early with any value
/// that is `enough`.
template <int Dim, class Real>
Real climb(const Particle<Dim, Real>& one, const Particle<Dim, Real>& two,
           const Point<Dim, Real>& d, Point<Dim, Real> n, Real enough) {
  constexpr double shortest_step = 1e-10;  // g is flat there: an error of 1e-20 in relative terms
  constexpr int max_steps = 200;
  Separation<Dim, Real> here = separation_along(one, two, d, n);
  for (int step = 0; step < max_steps && here.gap < enough; ++step) {
    Point<Dim, Real> turn = here.step;
    Point<Dim, Real> next = (n + turn).normalized();
    Separation<Dim, Real> there = separation_along(one, two, d, next);
    while (there.gap < here.gap && turn.norm() > shortest_step) {
      turn /= 2;
      next = (n + turn).normalized();
      there = separation_along(one, two, d, next);
    }
    if (there.gap > here.gap) n = next, here = there;
    if (turn.norm() <= shortest_step) break;
  }
  return here.gap;
}

/// A direction that separates disjoint ellipses. Between its two positive roots the polynomial p(t)
/// = t³ + G₁t² + (G₂/q)t + 1/q is negative, and (Σ₁ + tΣ₂)⁻¹d separates for every such t: take the
/// minimum of p.
template <class Real>
Point<2, Real> separating_direction(const Particle<2, Real>& one, const Particle<2, Real>& two,
                                    const Point<2, Real>& d, const VieillardBaron<Real>& contact) {
  const EllipseAxes<Real>& e = one.axes;
  const EllipseAxes<Real>& f = two.axes;
  const Real ratio = (e.a * e.b) / (f.a * f.b);
  const Real g = contact.g1;
  const Real root = sqrt(std::max<Real>(0, g * g - 3 * contact.g2 * ratio * ratio));
  // The larger root of 3t² + 2G₁t + G₂/q, without cancellation for either sign of G₁.
  const Real t = g < 0 ? (root - g) / 3 : -contact.g2 * ratio * ratio / (g + root);
  const auto adjugate_times = [](const EllipseAxes<Real>& axes,
                                 const Point<2, Real>& x) -> Point<2, Real> {
    const Real along = (x.x() * axes.cosine + x.y() * axes.sine) * axes.b * axes.b;
    const Real across = (x.y() * axes.cosine - x.x() * axes.sine) * axes.a * axes.a;
    return {along * axes.cosine - across * axes.sine, along * axes.sine + across * axes.cosine};
  };
  return (adjugate_times(e, d) + t * adjugate_times(f, d)).stableNormalized();
}

/// Evenly spread over the unit circle, and over the unit sphere (Fibonacci's lattice).
template <int Dim>
constexpr int sample_count = Dim == 2 ? 64 : 512;

Vec2 sample_point(int k, const Vec2&) {
  const auto [cosine, sine] = cosine_and_sine(2 * std::numbers::pi * k / sample_count<2>);
  return {cosine, sine};
}

Vec3 sample_point(int k, const Vec3&) {
  const double z = 1 - (2 * k + 1) / static_cast<double>(sample_count<3>);
  const auto [cosine, sine] = cosine_and_sine(2 * std::numbers::pi * k / std::numbers::phi);
  const double radius = sqrt(1 - z * z);
  return {radius * cosine, radius * sine, z};
}

template <int Dim>
const std::array<Vec<Dim>, sample_count<Dim>>& sample_points() {
  static const auto points = [] {
    std::array<Vec<Dim>, sample_count<Dim>> table;
    for (int k = 0; k < sample_count<Dim>; ++k) table[k] = sample_point(k, Vec<Dim>{});
    return table;
  }();
  return points;
}

/// The normal of a body at the image of the point e of the unit circle or sphere.
template <class Real>
Point<2, Real> normal_at(const EllipseAxes<Real>& body, const Vec2& e) {
  const Real along = body.b * e.x();
  const Real across = body.a * e.y();
  return Point<2, Real>(along * body.cosine - across * body.sine,
                        along * body.sine + across * body.cosine)
      .normalized();
}

template <class Real>
Point<3, Real> normal_at(const EllipsoidAxes<Real>& body, const Vec3& e) {
  return (body.directions * e.cast<Real>().cwiseQuotient(body.lengths)).normalized();
}

/// The highest of many normals of both bodies, spread so that sharp tips get their share, then the
/// maximum next to it. Ends early with any value that is `enough`.
template <int Dim, class Real>
Real overlap_gap(const Particle<Dim, Real>& one, const Particle<Dim, Real>& two,
                 const Point<Dim, Real>& d, Real enough) {
  Point<Dim, Real> best = Point<Dim, Real>::UnitX();
  Real highest = -std::numeric_limits<Real>::infinity();
  for (const Particle<Dim, Real>* body : {&one, &two}) {
    for (const Vec<Dim>& point : sample_points<Dim>()) {
      const Point<Dim, Real> n = normal_at(body->axes, point);
      const Real gap = separation_along(one, two, d, n).gap;
      if (gap >= enough) return gap;
      if (gap > highest) highest = gap, best = n;
    }
  }
  return climb(one, two, d, best, enough);
}

template <class Real>
bool is_round(const EllipseAxes<Real>& e) {
  return e.a == e.b;
}

template <class Real>
bool is_round(const EllipsoidAxes<Real>& e) {
  return e.lengths[0] == e.lengths[1] && e.lengths[1] == e.lengths[2];
}

/// Whether double precision proves that the surfaces are more than `gap` ≥ 0 apart: at any unit vector n,
/// n·d − h₁(n) − h₂(n) is a lower bound of their distance. Start with n along d. The normal of touching
/// bodies obeys n ∝ (Σ₁/h₁ + Σ₂/h₂)⁻¹d, and a few iterations of that come close to the best n of others.
///
/// The unit of length is a₁ + a₂. With u = 2⁻⁵³, d and n·d are good to 8u|d|. As |Aᵀn| changes by no more
/// than Aᵀn does, h₁ and h₂ are good to 16u together, whatever the aspect ratio. The margin 2⁻⁴⁰ (1 + |d|)
/// is 2⁹ times as much.
template <int Dim, class Real>
bool surely_apart(const Particle<Dim, Real>& one, const Particle<Dim, Real>& two,
                  const Point<Dim, Real>& d, double gap) {
  constexpr int max_steps = 3;
  using Square = Matrix<Dim, double>;
  const Real scale = 1 / (one.circumradius + two.circumradius);
  const Square axes1 = (scale * semi_axes(one.axes)).template cast<double>();
  const Square axes2 = (scale * semi_axes(two.axes)).template cast<double>();
  const Vec<Dim> distance = (scale * d).template cast<double>();
  const double enough = static_cast<double>(scale) * gap + 0x1p-40 * (1 + distance.norm());
  Vec<Dim> n = distance.normalized();
  for (int step = 0; step < max_steps; ++step) {
    const double h1 = (axes1.transpose() * n).norm();
    const double h2 = (axes2.transpose() * n).norm();
    if (n.dot(distance) - h1 - h2 > enough) return true;
    const Square sum = axes1 * axes1.transpose() / h1 + axes2 * axes2.transpose() / h2;
    n = (sum.inverse() * distance).normalized();
  }
  return false;
}

/// For round bodies, and for those that double precision proves to be more than `enough` apart.
template <int Dim, class Real>
std::optional<Finding<Real>> quick_finding(const Particle<Dim, Real>& one,
                                           const Particle<Dim, Real>& two,
                                           const Point<Dim, Real>& d, Real enough) {
  if (is_round(one.axes) && is_round(two.axes)) {
    const Real gap = d.norm() - (one.circumradius + two.circumradius);
    return Finding<Real>{gap < 0, gap};
  }
  if (surely_apart(one, two, d, std::max(0.0, static_cast<double>(enough))))
    return Finding<Real>{false, enough};
  return {};
}

template <class Real>
Finding<Real> general_finding(const Particle<2, Real>& one, const Particle<2, Real>& two,
                              const Point<2, Real>& d, bool apart, Real enough) {
  const auto contact = vieillard_baron<Real>(one.axes, two.axes, d.x(), d.y());
  if (!apart && !contact.disjoint_or_touching()) return {true, overlap_gap(one, two, d, enough)};
  return {false, climb(one, two, d, separating_direction(one, two, d, contact), enough)};
}

template <class Real>
Finding<Real> general_finding(const Particle<3, Real>& one, const Particle<3, Real>& two,
                              const Point<3, Real>& d, bool apart, Real enough) {
  if (!apart && !ellipsoid_eta<Real>(one.axes, two.axes, d).disjoint_or_touching())
    return {true, overlap_gap(one, two, d, enough)};
  return {false, climb(one, two, d, ellipsoid_touch<Real>(one.axes, two.axes, d).normal, enough)};
}

}  // namespace

template <class Real>
Particle<2, Real> particle(const Ellipse& shape, const Pose2& pose) {
  const auto [cosine, sine] = extended_cosine_and_sine(pose.angle);
  return {pose.position.cast<Real>(),
          {shape.a, shape.b, static_cast<Real>(cosine), static_cast<Real>(sine)},
          shape.a};
}

template <class Real>
Particle<3, Real> particle(const Ellipsoid& shape, const Pose3& pose) {
  return {pose.position.cast<Real>(), {shape, pose.orientation}, shape.circumradius()};
}

template <int Dim, class Real>
Finding<Real> examine(const Particle<Dim, Real>& one, const Particle<Dim, Real>& two,
                      const std::type_identity_t<Point<Dim, Real>>& d,
                      std::type_identity_t<Real> enough) {
  if (const auto finding = quick_finding(one, two, d, enough)) return *finding;
  const bool apart = d.norm() >= one.circumradius + two.circumradius;
  return general_finding(one, two, d, apart, enough);
}

#define VITREL_INSTANTIATE(Real)                                                     \
  template Particle<2, Real> particle(const Ellipse&, const Pose2&);                 \
  template Particle<3, Real> particle(const Ellipsoid&, const Pose3&);               \
  template Finding<Real> examine(const Particle<2, Real>&, const Particle<2, Real>&, \
                                 const Point<2, Real>&, Real);                       \
  template Finding<Real> examine(const Particle<3, Real>&, const Particle<3, Real>&, \
                                 const Point<3, Real>&, Real);
VITREL_INSTANTIATE(long double)
VITREL_INSTANTIATE(DoubleDouble)

}  // namespace vitrel::exact
