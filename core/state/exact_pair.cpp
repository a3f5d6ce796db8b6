#include "core/state/exact_pair.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.h"

namespace vitrel::exact {
namespace {

constexpr double longest_step = 0.1;

template <int Dim, class Real>
struct Pair {
  const Particle<Dim, Real>&one, &two;
  const Point<Dim, Real>& d;
};

template <int Dim, class Real>
using Matrix = Eigen::Matrix<Real, Dim, Dim>;

/// Returns the matrix A whose columns are the semi-axes: Σ = AAᵀ and h = |Aᵀn|.
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

/// Returns the unit vectors that complete n to an orthonormal basis, as columns.
template <class Real>
Point<2, Real> tangents(const Point<2, Real>& n) {
  return {-n.y(), n.x()};
}

template <class Real>
Eigen::Matrix<Real, 3, 2> tangents(const Point<3, Real>& n) {
  Eigen::Matrix<Real, 3, 2> t;
  t.col(0) = n.unitOrthogonal();
  t.col(1) = n.cross(t.col(0));
  return t;
}

/// The support function h at a unit vector n, its gradient Σn/h, and its matrix of second derivatives Σ/h − Σn(Σn)ᵀ/h³,
/// both in the directions of the tangents t.
template <int Dim, class Real>
struct Support {
  Real h;
  Point<Dim - 1, Real> slope;
  Matrix<Dim - 1, Real> bend;

  Support(const Matrix<Dim, Real>& axes, const Point<Dim, Real>& n,
          const Eigen::Matrix<Real, Dim, Dim - 1>& t) {
    const Point<Dim, Real> along = axes.transpose() * n;
    const Eigen::Matrix<Real, Dim, Dim - 1> across = axes.transpose() * t;
    h = norm(along);
    slope = across.transpose() * along / h;
    bend = (across.transpose() * across - slope * slope.transpose()) / h;
  }
};

/// g(n) = n·d − h₁(n) − h₂(n) at a unit vector n, and the step of n along its tangents that Newton's method takes to
/// the maximum. Where g is not concave, the step is uphill and has the largest length allowed.
template <int Dim, class Real>
struct Separation {
  Real gap;
  Point<Dim, Real> step;
};

/// On the sphere the second derivatives are those in space minus g times the unit matrix, since all terms of g are
/// homogeneous in n.
template <int Dim, class Real>
Separation<Dim, Real> separation_along(const Pair<Dim, Real>& pair, const Point<Dim, Real>& n) {
  const auto t = tangents(n);
  const Support<Dim, Real> first(semi_axes(pair.one.axes), n, t);
  const Support<Dim, Real> second(semi_axes(pair.two.axes), n, t);
  const Real gap = dot(n, pair.d) - first.h - second.h;
  const Point<Dim - 1, Real> slope = t.transpose() * pair.d - first.slope - second.slope;
  Matrix<Dim - 1, Real> bend = first.bend + second.bend;
  bend.diagonal().array() += gap;
  const bool concave = bend(0, 0) > 0 && bend.determinant() > 0;
  Point<Dim - 1, Real> turn = slope;
  if (concave) turn = bend.inverse() * slope;
  const Real length = norm(turn);
  if (length > longest_step || (!concave && length > 0)) turn *= longest_step / length;
  return {gap, t * turn};
}

/// Returns the local maximum of g above n by Newton's method, which halves every step that would lead down. Where g > 0
/// it is strictly concave on the sphere, so that there is only one maximum. Returns early with any value that is at
/// least `enough`.
template <int Dim, class Real>
Real climb(const Pair<Dim, Real>& pair, Point<Dim, Real> n, Real enough) {
  constexpr double shortest_step = 1e-10;  // g is flat there: a relative error of 1e-20
  constexpr int max_steps = 200;
  Separation<Dim, Real> here = separation_along(pair, n);
  for (int step = 0; step < max_steps && here.gap < enough; ++step) {
    Point<Dim, Real> turn = here.step;
    Point<Dim, Real> next = normalized(n + turn);
    Separation<Dim, Real> there = separation_along(pair, next);
    while (there.gap < here.gap && norm(turn) > shortest_step) {
      turn /= 2;
      next = normalized(n + turn);
      there = separation_along(pair, next);
    }
    if (there.gap > here.gap) n = next, here = there;
    if (norm(turn) <= shortest_step) break;
  }
  return here.gap;
}

template <class Real>
VieillardBaron<Real> criterion(const Pair<2, Real>& pair) {
  return vieillard_baron<Real>(pair.one.axes, pair.two.axes, pair.d.x(), pair.d.y());
}

template <class Real>
EllipsoidEta<Real> criterion(const Pair<3, Real>& pair) {
  return ellipsoid_eta<Real>(pair.one.axes, pair.two.axes, pair.d);
}

/// Returns a direction that separates disjoint ellipses. Between its two positive roots the polynomial
/// p(t) = t³ + G₁t² + (G₂/q)t + 1/q is negative, and (Σ₁ + tΣ₂)⁻¹d is a separating direction for every such t, for
/// example at the minimum of p.
template <class Real>
Point<2, Real> separating_direction(const Pair<2, Real>& pair) {
  using std::sqrt;
  const EllipseAxes<Real>&e = pair.one.axes, &f = pair.two.axes;
  const auto [psi, g1, g2] = criterion(pair);
  const Real ratio = (e.a * e.b) / (f.a * f.b);
  const Real root = sqrt(std::max<Real>(0, g1 * g1 - 3 * g2 * ratio * ratio));
  // This is the larger root of 3t² + 2G₁t + G₂/q, without cancellation for either sign of G₁.
  const Real t = g1 < 0 ? (root - g1) / 3 : -g2 * ratio * ratio / (g1 + root);
  const Matrix<2, Real> axes1 = semi_axes(e), axes2 = semi_axes(f);
  const Matrix<2, Real> m = axes1 * axes1.transpose() + t * (axes2 * axes2.transpose());
  const Point<2, Real>& d = pair.d;
  return Point<2, Real>(m(1, 1) * d.x() - m(0, 1) * d.y(), m(0, 0) * d.y() - m(1, 0) * d.x())
      .stableNormalized();
}

template <class Real>
Point<3, Real> separating_direction(const Pair<3, Real>& pair) {
  return ellipsoid_touch<Real>(pair.one.axes, pair.two.axes, pair.d).normal;
}

/// The number of sample points, which are evenly spread over the unit circle or the unit sphere (Fibonacci's lattice).
template <int Dim>
constexpr int sample_count = Dim == 2 ? 64 : 512;

Vec2 sample_point(int k, const Vec2&) {
  return direction(2 * std::numbers::pi * k / sample_count<2>);
}

Vec3 sample_point(int k, const Vec3&) {
  const double z = 1 - (2 * k + 1) / static_cast<double>(sample_count<3>);
  const Vec2 turned =
      std::sqrt(1 - z * z) * direction(2 * std::numbers::pi * k / std::numbers::phi);
  return {turned.x(), turned.y(), z};
}

/// Returns the maximum of g for overlapping bodies. It evaluates g at many normals of both bodies and climbs from the
/// highest value. The normals are those at the images of the sample points of the unit circle or sphere, so that sharp
/// tips are sampled as well. Returns early with any value that is at least `enough`.
template <int Dim, class Real>
Real overlap_gap(const Pair<Dim, Real>& pair, Real enough) {
  Point<Dim, Real> best = Point<Dim, Real>::UnitX();
  Real highest = -std::numeric_limits<Real>::infinity();
  for (const Particle<Dim, Real>* body : {&pair.one, &pair.two}) {
    const Matrix<Dim, double> axes = semi_axes(body->axes).template cast<double>();
    const Matrix<Dim, double> normals = inverse(axes).transpose();
    for (int k = 0; k < sample_count<Dim>; ++k) {
      const Vec<Dim> normal = normals * sample_point(k, Vec<Dim>{});
      const Point<Dim, Real> n = normalized(normal.template cast<Real>());
      const Real gap = separation_along(pair, n).gap;
      if (gap >= enough) return gap;
      if (gap > highest) highest = gap, best = n;
    }
  }
  return climb(pair, best, enough);
}

/// Returns whether double precision proves that the surfaces are more than `gap` ≥ 0 apart: at any unit vector n,
/// n·d − h₁(n) − h₂(n) is a lower bound of their distance. The search starts with n along d. The normal of touching
/// bodies obeys n ∝ (Σ₁/h₁ + Σ₂/h₂)⁻¹d, and a few iterations of this equation come close to the best n of bodies that
/// do not touch.
///
/// The unit of length is a₁ + a₂. With u = 2⁻⁵³, the errors of d and n·d are at most 8u|d|. As |Aᵀn| changes by no more
/// than Aᵀn does, the errors of h₁ and h₂ are at most 16u together, whatever the aspect ratio. The margin 2⁻⁴⁰ (1 +
/// |d|) is 2⁹ times as much.
template <int Dim, class Real>
bool surely_apart(const Pair<Dim, Real>& pair, double gap) {
  constexpr int max_steps = 3;
  using Square = Matrix<Dim, double>;
  const Real scale = 1 / (pair.one.circumradius + pair.two.circumradius);
  const Square axes1 = (scale * semi_axes(pair.one.axes)).template cast<double>();
  const Square axes2 = (scale * semi_axes(pair.two.axes)).template cast<double>();
  const Vec<Dim> distance = (scale * pair.d).template cast<double>();
  const double enough = static_cast<double>(scale) * gap + 0x1p-40 * (1 + norm(distance));
  Vec<Dim> n = normalized(distance);
  for (int step = 0; step < max_steps; ++step) {
    const double h1 = norm(axes1.transpose() * n);
    const double h2 = norm(axes2.transpose() * n);
    if (dot(n, distance) - h1 - h2 > enough) return true;
    const Square sum = axes1 * axes1.transpose() / h1 + axes2 * axes2.transpose() / h2;
    n = normalized(inverse(sum) * distance);
  }
  return false;
}

}  // namespace

template <class Real>
Particle<2, Real> particle(const Ellipse& shape, const Pose2& pose) {
  EllipseAxes<Real> axes{shape.a, shape.b, 1, 0};
  if (!shape.is_round()) {
    const auto [cosine, sine] = extended_cosine_and_sine(pose.angle);
    axes.cosine = static_cast<Real>(cosine);
    axes.sine = static_cast<Real>(sine);
  }
  return {pose.position.cast<Real>(), axes, shape.a, shape.is_round()};
}

template <class Real>
Particle<3, Real> particle(const Ellipsoid& shape, const Pose3& pose) {
  const EllipsoidAxes<Real> axes(shape, pose.orientation);
  return {pose.position.cast<Real>(), axes, shape.circumradius(), shape.is_round()};
}

template <int Dim, class Real>
Finding<Real> examine(const Particle<Dim, Real>& one, const Particle<Dim, Real>& two,
                      const std::type_identity_t<Point<Dim, Real>>& d,
                      std::type_identity_t<Real> enough) {
  const Pair<Dim, Real> pair{one, two, d};
  const Real circles = norm(d) - (one.circumradius + two.circumradius);
  if (one.is_round && two.is_round) return {circles < 0, circles};
  if (surely_apart(pair, std::max(0.0, static_cast<double>(enough)))) return {false, enough};
  if (circles < 0 && !criterion(pair).disjoint_or_touching())
    return {true, overlap_gap(pair, enough)};
  return {false, climb(pair, separating_direction(pair), enough)};
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
