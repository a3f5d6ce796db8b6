#include "bench/surveys/ellipsoid_reference.h"

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
using Outcome = TrueEllipsoidContact::Outcome;

constexpr Real rounding = std::numeric_limits<Real>::epsilon();

/// x ↦ ω × x
Matrix cross_product_with(const Vector& omega) {
  Matrix m;
  m << 0, -omega.z(), omega.y(), omega.z(), 0, -omega.x(), -omega.y(), omega.x(), 0;
  return m;
}

Matrix commutator(const Matrix& a, const Matrix& b) {
  return a * b - b * a;
}

/// The rotation by the vector ω t (Rodrigues).
Matrix turn(const Vector& turned) {
  const Real angle = turned.norm();
  if (angle == 0) return Matrix::Identity();
  const Matrix u = cross_product_with(turned / angle);
  const Real half = std::sin(angle / 2);
  return Matrix::Identity() + std::sin(angle) * u + 2 * half * half * (u * u);
}

class Body {
 public:
  Body(const Flight<GrowingEllipsoid>& flight, Real)
      : shape_(flight.body.shape),
        at_start_(shape_, flight.pose.orientation),
        size_(flight.body.size),
        growth_(flight.body.growth_rate),
        omega_(flight.motion.angular_velocity.cast<Real>()) {}
  Body(const Flight<TumblingEllipsoid>& flight, Real end)
      : Body({{flight.body.shape, 1, 0}, flight.pose, flight.motion}, end) {
    constexpr int scalene = 3;
    if (shape_.rotations() == scalene)
      top_.emplace(shape_, flight.pose.orientation, flight.motion.angular_velocity, end);
  }

  Real size_at(Real time) const { return size_ + growth_ * time; }
  bool is_round() const { return shape_.is_round(); }
  Real radius_at(Real time) const { return shape_.circumradius() * size_at(time); }

  /// A small body for a point.
  EllipsoidAxes<Real> axes_at(Real time) const {
    constexpr Real smallest = 1e-9L;
    EllipsoidAxes<Real> axes = at_start_;
    axes.directions = rotation_at(time).axes;
    axes.lengths *= std::max(size_at(time), smallest);
    return axes;
  }

  /// How the support function grows, s h, with its derivative in time.
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

  /// The most of d²(s h)/dt² up to the horizon.
  Real bend(Real horizon) const {
    if (top_) return tumbling_bend();
    const Matrix axes = at_start_.directions * at_start_.lengths.asDiagonal();
    const Matrix omega = cross_product_with(omega_);
    const Matrix second = commutator(omega, commutator(omega, axes * axes.transpose()));
    const Real most = std::max(size_, size_at(horizon));
    return most * second.norm() / (2 * shape_.inradius()) +
           2 * std::abs(growth_) * omega_.norm() * shape_.max_support_rate();
  }

  /// By how much a relative error of the initial state rotates the body.
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
  std::optional<TaylorTop> top_;  ///< of a scalene body that tumbles
};

Vector difference(const Vec3& to, const Vec3& from) {
  return to.cast<Real>() - from.cast<Real>();
}

struct Pair {
  template <class B>
  Pair(const Flight<B>& first, const Flight<B>& second, Real end)
      : one(first, end),
        two(second, end),
        start(difference(second.pose.position, first.pose.position)),
        velocity(difference(second.motion.velocity, first.motion.velocity)) {}

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

  /// By how much a gap may be off.
  Real blur(Real time) const {
    return 64 * rounding *
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

/// The positive root of gap + rate s − ½ bend s², if any; gap > 0.
Real safe_step(Real gap, Real rate, Real bend) {
  const Real root = std::sqrt(rate * rate + 2 * bend * gap);
  if (rate < 0) return 2 * gap / (root - rate);
  return bend > 0 ? (rate + root) / bend : std::numeric_limits<Real>::infinity();
}

/// An overlap soon after the time up to which the pair is disjoint, if the surfaces cross there.
std::optional<Real> overlap_beyond(const Pair& pair, Real time, Real approach_speed) {
  constexpr int doublings = 8;
  if (approach_speed <= 0) return {};
  Real ahead = 4 * std::max(pair.blur(time) / approach_speed, rounding * time);
  for (int k = 0; k < doublings; ++k, ahead *= 2)
    if (pair.overlapping(time + ahead)) return time + ahead;
  return {};
}

/// Where `holds` begins to be false, between a time at which it is true and one at which it is not.
template <class Condition>
Real last_time(Real yes, Real no, const Condition& holds) {
  while (true) {
    const Real middle = yes + (no - yes) / 2;
    if (middle <= yes || middle >= no) return yes;
    (holds(middle) ? yes : no) = middle;
  }
}

/// The surfaces touch where the overlap begins, as computed; rounding may hide a gap as large as the one before it.
TrueEllipsoidContact crossing_between(const Pair& pair, Real disjoint, Real overlapping,
                                      int pieces) {
  TrueEllipsoidContact found;
  found.outcome = Outcome::contact;
  found.time = last_time(disjoint, overlapping, [&](Real t) { return !pair.overlapping(t); });
  found.uncertainty =
      found.time - last_time(disjoint, found.time, [&](Real t) { return pair.disjoint(t); });
  found.pieces = pieces;
  return found;
}

TrueEllipsoidContact search(const Pair& pair, Real horizon) {
  constexpr int max_pieces = 10'000'000;
  TrueEllipsoidContact found;
  if (pair.overlapping(0)) {
    found.outcome = Outcome::overlap_at_start;
    return found;
  }
  const Real bend = pair.one.bend(horizon) + pair.two.bend(horizon);
  Real time = 0;
  for (int pieces = 1; pieces <= max_pieces; ++pieces) {
    found.pieces = pieces;
    const Pair::Separation here = pair.separation(time);
    const Real gap = here.gap - pair.blur(time);
    const Real next = gap > 0 ? time + safe_step(gap, here.rate, bend) : time;
    if (next > time) {
      if (!(next < horizon)) return found;
      time = next;
    } else if (const auto overlap = overlap_beyond(pair, time, -here.rate)) {
      found = crossing_between(pair, time, *overlap, pieces);
      if (found.time > horizon) found.outcome = Outcome::none;
      return found;
    } else {
      break;
    }
  }
  found.outcome = Outcome::undecided;
  found.time = time;
  return found;
}

TrueEllipsoidContact described_contact(const Pair& pair, double horizon) {
  TrueEllipsoidContact found = search(pair, horizon);
  if (found.outcome == Outcome::contact || found.outcome == Outcome::undecided) {
    const Pair::Separation there = pair.separation(found.time);
    found.normal = there.normal.cast<double>();
    found.approach_speed = static_cast<double>(-there.rate);
  }
  return found;
}

long double gap(const Pair& pair, Real time) {
  const auto particle = [&](const Body& body, const Vector& centre) -> exact::Particle<3, Real> {
    return {centre, body.axes_at(time), body.radius_at(time), body.is_round()};
  };
  return exact::examine(particle(pair.one, Vector::Zero()), particle(pair.two, pair.d(time)),
                        pair.d(time), std::numeric_limits<Real>::infinity())
      .gap;
}

}  // namespace

TrueEllipsoidContact true_first_contact(const Flight<GrowingEllipsoid>& one,
                                        const Flight<GrowingEllipsoid>& two, double horizon) {
  return described_contact({one, two, horizon}, horizon);
}

TrueEllipsoidContact true_first_contact(const Flight<TumblingEllipsoid>& one,
                                        const Flight<TumblingEllipsoid>& two, double horizon) {
  return described_contact({one, two, horizon}, horizon);
}

long double true_gap(const Flight<GrowingEllipsoid>& one, const Flight<GrowingEllipsoid>& two,
                     long double time) {
  return gap({one, two, time}, time);
}

long double true_gap(const Flight<TumblingEllipsoid>& one, const Flight<TumblingEllipsoid>& two,
                     long double time) {
  return gap({one, two, time}, time);
}

}  // namespace vitrel::bench
