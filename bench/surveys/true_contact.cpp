#include "bench/surveys/true_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "bench/reference/taylor_top.h"
#include "core/state/exact_pair.h"

namespace vitrel::bench {
namespace {

using Real = long double;
using Vector = exact::Point<3, Real>;
using Matrix = Eigen::Matrix<Real, 3, 3>;

constexpr Real rounding = std::numeric_limits<Real>::epsilon();

/// The matrix of x ↦ ω × x.
Matrix cross_product_with(const Vector& omega) {
  Matrix m;
  m << 0, -omega.z(), omega.y(), omega.z(), 0, -omega.x(), -omega.y(), omega.x(), 0;
  return m;
}

Matrix commutator(const Matrix& a, const Matrix& b) {
  return a * b - b * a;
}

/// The rotation by the rotation vector `turned` (Rodrigues' formula).
Matrix turn(const Vector& turned) {
  const Real angle = turned.norm();
  if (angle == 0) return Matrix::Identity();
  const Matrix u = cross_product_with(turned / angle);
  const Real half = std::sin(angle / 2);
  return Matrix::Identity() + std::sin(angle) * u + 2 * half * half * (u * u);
}

/// The vector of the plane, or of space, as a vector in space.
Vector in_space(const Vec2& v) {
  return {v.x(), v.y(), 0};
}
Vector in_space(const Vec3& v) {
  return v.cast<Real>();
}

class Body {
 public:
  Body(const Flight<GrowingEllipsoid>& flight, Real)
      : shape_(flight.body.shape),
        at_start_(shape_, flight.pose.orientation),
        size_(flight.body.size),
        growth_(flight.body.growth_rate),
        omega_(flight.motion.angular_velocity.cast<Real>()) {}
  /// An ellipse is the section of a spheroid.
  Body(const Flight<GrowingEllipse>& flight, Real end)
      : Body({{{Vec3(flight.body.shape.a, flight.body.shape.b, flight.body.shape.a)},
               flight.body.size,
               flight.body.growth_rate},
              {Vec3::Zero(), Quaternion::Identity()},
              {Vec3::Zero(), Vec3(0, 0, flight.motion.angular_velocity)}},
             end) {
    at_start_.directions = turn(Vector(0, 0, flight.pose.angle));
  }
  Body(const Flight<TumblingEllipsoid>& flight, Real end)
      : Body({{flight.body.shape, 1, 0}, flight.pose, flight.motion}, end) {
    constexpr int scalene = 3;
    if (shape_.rotations() == scalene)
      top_.emplace(shape_, flight.pose.orientation, flight.motion.angular_velocity, end);
  }

  Real size_at(Real time) const { return size_ + growth_ * time; }
  bool is_round() const { return shape_.is_round(); }
  Real radius_at(Real time) const { return shape_.circumradius() * size_at(time); }

  /// The axes at a time. A point has a small size instead of 0.
  EllipsoidAxes<Real> axes_at(Real time) const {
    constexpr Real smallest = 1e-18L;
    EllipsoidAxes<Real> axes = at_start_;
    axes.directions = rotation_at(time).axes;
    axes.lengths *= std::max(size_at(time), smallest);
    return axes;
  }

  /// The support function s h with its time derivative.
  struct Support {
    Real height, rate;
  };
  Support support(Real time, const Vector& n) const {
    const TaylorTop::State now = rotation_at(time);
    const Matrix axes = now.axes * at_start_.lengths.asDiagonal();
    const Vector along = axes.transpose() * n;
    const Real h = along.norm();
    const Vector point = axes * (along / h);
    return {size_at(time) * h,
            growth_ * h - size_at(time) * point.dot(now.angular_velocity.cross(n))};
  }

  /// An upper bound of d²(s h)/dt² up to the horizon.
  Real bend(Real horizon) const {
    if (top_) return tumbling_bend();
    const Matrix axes = at_start_.directions * at_start_.lengths.asDiagonal();
    const Matrix omega = cross_product_with(omega_);
    const Matrix second = commutator(omega, commutator(omega, axes * axes.transpose()));
    const Real most = std::max(size_, size_at(horizon));
    return most * second.norm() / (2 * shape_.inradius()) +
           2 * std::abs(growth_) * omega_.norm() * shape_.max_support_rate();
  }

  /// The angle by which the body is off, over the relative error of its initial state.
  Real phase(Real time) const { return top_ ? top_->sensitivity(time) : omega_.norm() * time; }

 private:
  TaylorTop::State rotation_at(Real time) const {
    if (top_) return top_->at(time);
    return {turn(omega_ * time) * at_start_.directions, omega_};
  }

  Real tumbling_bend() const {
    const Real a = shape_.circumradius(), c = shape_.inradius(), speed = top_->speed_bound();
    return (1 + std::numbers::inv_sqrt3_v<Real> / 2) * (a - c) * (a + c) * speed * speed / c;
  }

  Ellipsoid shape_;
  EllipsoidAxes<Real> at_start_;
  Real size_, growth_;
  Vector omega_;
  std::optional<TaylorTop> top_;  ///< for a scalene body that tumbles
};

struct Pair {
  template <class B>
  Pair(const Flight<B>& first, const Flight<B>& second, Real end)
      : one(first, end),
        two(second, end),
        start(in_space(second.pose.position) - in_space(first.pose.position)),
        velocity(in_space(second.motion.velocity) - in_space(first.motion.velocity)) {}

  Vector d(Real time) const { return start + velocity * time; }

  Vector initial_axis(Real time) const {
    return ellipsoid_touch<Real>(one.axes_at(time), two.axes_at(time), d(time)).normal;
  }

  struct Separation {
    Real gap, rate;
    Vector normal;
  };
  Separation separation(Real time) const {
    const Vector n = initial_axis(time);
    const Body::Support first = one.support(time, n), second = two.support(time, n);
    return {n.dot(d(time)) - first.height - second.height,
            n.dot(velocity) - first.rate - second.rate, n};
  }

  /// A bound of the error of the gap by rounding.
  Real blur(Real time) const {
    return 8 * rounding *
           (d(time).norm() + one.radius_at(time) * (1 + one.phase(time)) +
            two.radius_at(time) * (1 + two.phase(time)));
  }

  bool disjoint(Real time) const { return separation(time).gap > blur(time); }
  bool overlapping(Real time) const {
    return !disjoint(time) && !ellipsoid_eta<Real>(one.axes_at(time), two.axes_at(time), d(time))
                                   .disjoint_or_touching();
  }

  Body one, two;
  Vector start, velocity;
};

/// The positive root s of gap + rate s − ½ bend s², where gap > 0; infinity if there is none.
Real safe_step(Real gap, Real rate, Real bend) {
  const Real root = std::sqrt(rate * rate + 2 * bend * gap);
  if (rate < 0) return 2 * gap / (root - rate);
  return bend > 0 ? (rate + root) / bend : std::numeric_limits<Real>::infinity();
}

/// Finds an overlap soon after the time up to which the pair is disjoint, if the surfaces cross there.
std::optional<Real> overlap_beyond(const Pair& pair, Real time, Real approach_speed) {
  constexpr int doublings = 8;
  if (approach_speed <= 0) return {};
  Real ahead = 4 * std::max(pair.blur(time) / approach_speed, rounding * time);
  for (int k = 0; k < doublings; ++k, ahead *= 2)
    if (pair.overlapping(time + ahead)) return time + ahead;
  return {};
}

/// The last time at which `holds` is true, between a time at which it is true and one at which it is false.
template <class Condition>
Real last_time(Real yes, Real no, const Condition& holds) {
  while (true) {
    const Real middle = yes + (no - yes) / 2;
    if (middle <= yes || middle >= no) return yes;
    (holds(middle) ? yes : no) = middle;
  }
}

/// The result of the search.
struct Found {
  TruthOutcome outcome = TruthOutcome::none;
  Real time = 0, uncertainty = 0;
  int pieces = 0;
};

/// The surfaces touch where the computed overlap begins. Rounding may hide a gap, so the uncertainty reaches back to
/// the last time at which the bodies are known to be disjoint.
Found crossing_between(const Pair& pair, Real disjoint, Real overlapping, int pieces) {
  const Real time = last_time(disjoint, overlapping, [&](Real t) { return !pair.overlapping(t); });
  const Real known = last_time(disjoint, time, [&](Real t) { return pair.disjoint(t); });
  return {TruthOutcome::contact, time, time - known, pieces};
}

Found search(const Pair& pair, Real horizon) {
  constexpr int max_pieces = 10'000'000;
  if (pair.overlapping(0)) return {TruthOutcome::overlap_at_start};
  const Real bend = pair.one.bend(horizon) + pair.two.bend(horizon);
  Real time = 0;
  int pieces = 1;
  for (; pieces <= max_pieces; ++pieces) {
    const Pair::Separation here = pair.separation(time);
    const Real gap = here.gap - pair.blur(time);
    const Real next = gap > 0 ? time + safe_step(gap, here.rate, bend) : time;
    if (next > time) {
      if (!(next < horizon)) return {TruthOutcome::none, 0, 0, pieces};
      time = next;
    } else if (const auto overlap = overlap_beyond(pair, time, -here.rate)) {
      const Found found = crossing_between(pair, time, *overlap, pieces);
      return found.time > horizon ? Found{TruthOutcome::none, 0, 0, pieces} : found;
    } else {
      break;
    }
  }
  return {TruthOutcome::undecided, time, 0, pieces};
}

template <int Dim>
exact::Particle<Dim, Real> particle(const Body& body, const Vector& centre, Real time) {
  const EllipsoidAxes<Real> axes = body.axes_at(time);
  const Real radius = body.radius_at(time);
  if constexpr (Dim == 2)
    return {centre.head<2>(),
            {axes.lengths[0], axes.lengths[1], axes.directions(0, 0), axes.directions(1, 0)},
            radius,
            body.is_round()};
  else
    return {centre, axes, radius, body.is_round()};
}

}  // namespace

template <class B>
TrueContactOf<B::dimension> true_first_contact(const Flight<B>& one, const Flight<B>& two,
                                               double horizon) {
  const Pair pair(one, two, horizon);
  const Found found = search(pair, horizon);
  TrueContactOf<B::dimension> contact{found.outcome, found.time, found.uncertainty, found.pieces};
  if (found.outcome == TruthOutcome::contact || found.outcome == TruthOutcome::undecided) {
    const Pair::Separation there = pair.separation(found.time);
    contact.normal = there.normal.head<B::dimension>().template cast<double>();
    contact.approach_speed = static_cast<double>(-there.rate);
  }
  return contact;
}

template <class B>
long double true_gap(const Flight<B>& one, const Flight<B>& two, long double time) {
  const Pair pair(one, two, time);
  const Vector d = pair.d(time);
  constexpr int dim = B::dimension;
  return exact::examine(particle<dim>(pair.one, Vector::Zero(), time),
                        particle<dim>(pair.two, d, time), d.head<dim>(),
                        std::numeric_limits<Real>::infinity())
      .gap;
}

#define VITREL_INSTANTIATE(B)                                                                 \
  template TrueContactOf<B::dimension> true_first_contact(const Flight<B>&, const Flight<B>&, \
                                                          double);                            \
  template long double true_gap(const Flight<B>&, const Flight<B>&, long double);
VITREL_INSTANTIATE(GrowingEllipse)
VITREL_INSTANTIATE(GrowingEllipsoid)
VITREL_INSTANTIATE(TumblingEllipsoid)

}  // namespace vitrel::bench
