#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/contact/ellipsoid_gap.h"
#include "core/contact/first_contact.h"
#include "core/contact/support_gap.h"

namespace vitrel {

namespace detail {

constexpr double forever = 1e100;
constexpr int most_axes = 1000;
/// A gap up to this multiple of the contact gap counts as touching.
constexpr double touching = 1.25;
/// A leap ends where the gap is the contact gap to within this fraction.
constexpr double leap_accuracy = 0.25;

/// First root of c + slope s − ½ M s² = 0 for c ≥ 0 and any M; infinity if there is none.
inline double first_root(double c, double slope, double acceleration) {
  const double discriminant = slope * slope + 2 * acceleration * c;
  if (!(discriminant >= 0)) return std::numeric_limits<double>::infinity();
  const double root = std::sqrt(discriminant);
  if (slope < 0) return 2 * c / (root - slope);
  return acceleration > 0 ? (slope + root) / acceleration : std::numeric_limits<double>::infinity();
}

struct Interval {
  double begin, end;
  bool empty() const { return !(begin <= end); }
};
constexpr Interval at_no_time{1, 0};

// A part of [0, horizon] outside which |d + v t| > reach + growth t: from the first moment at which
// this is not so to the last (or to the horizon, if the circles grow faster than they move).
template <int Dim>
Interval time_within(const Vec<Dim>& d, const Vec<Dim>& v, double reach, double growth,
                     double horizon) {
  const double c = d.squaredNorm() - reach * reach;
  const double b = d.dot(v) - reach * growth;
  const double a = v.squaredNorm() - growth * growth;  // a t² + 2 b t + c ≤ 0 while within
  const double discriminant = b * b - a * c;
  const bool outside = c > 0;
  if (outside && discriminant < 0) return at_no_time;
  const double root = std::sqrt(std::max(discriminant, 0.0));
  if (outside && !(root - b > 0)) return at_no_time;
  const double begin = outside ? c / (root - b) : 0;
  if (!(a > 0)) return {begin, horizon};
  // The far root, in the form without cancellation.
  const double end = b <= 0 ? (root - b) / a : -c / (root + b);
  return {begin, std::min(end, horizon)};
}

/// How long a step in the tangent plane of the axes is, and the product of two.
inline double length(double turn) {
  return std::abs(turn);
}
inline double product(double one, double two) {
  return one * two;
}
inline double length(const Vec2& step) {
  return step.norm();
}
inline double product(const Vec2& one, const Vec2& two) {
  return one.dot(two);
}

}  // namespace detail

/// The search for one pair: the steps of first_contact.h, over a pair in flight of either dimension. An
/// axis is turned by steps in its tangent plane: a number in two dimensions, two in three.
template <class PairInFlight>
class AxisSearch {
  using Axis = typename PairInFlight::Axis;
  using Gap = typename PairInFlight::Gap;

 public:
  template <Body B>
  AxisSearch(const Flight<B>& one, const Flight<B>& two, double contact_gap)
      : flight_(one, two), contact_gap_(contact_gap) {}

  struct Found {
    Outcome outcome;
    int steps;
  };

  /// Flattened, since calls weigh in so short a search.
  [[gnu::flatten]] Found run(double horizon, const Axis* likely_axis) {
    const detail::Interval near = detail::time_within(
        flight_.d0(), flight_.v(), flight_.reach() + detail::touching * contact_gap_,
        flight_.reach_growth(), std::min(horizon, detail::forever));
    if (near.empty()) return {Outcome::none, 0};
    flight_.start_at(near.begin);
    look_along(likely_axis ? *likely_axis : flight_.likely_axis());
    if (!has_separating_axis()) return Found{Outcome::overlap, 1};

    for (int step = 1; step <= detail::most_axes; ++step) {
      if (here_.gap <= 4 * contact_gap_) perfect_axis();
      const double rate = flight_.gap_rate(n_, here_);
      const double room = here_.gap - contact_gap_;
      const double time_left = near.end - flight_.time();
      if (here_.gap <= detail::touching * contact_gap_ && rate < 0) return contact(step);
      if (time_left <= 0) return Found{Outcome::none, step};
      if (room + rate * time_left > 0) {
        if (is_open(here_, room, rate, time_left)) return Found{Outcome::none, step};
      } else if (room > 0 && crosses(rate) && leap(rate, near.end)) {
        return contact(step);
      }
      const double duration = safe_duration(rate, time_left);
      // Closing so fast that no double lies between now and the contact.
      if (rate < 0 && flight_.time() + duration == flight_.time()) return contact(step);
      advance(duration);
    }
    return Found{Outcome::not_converged, detail::most_axes};
  }

  double time() const { return flight_.time(); }
  const Axis& axis() const { return n_; }
  const PairInFlight& flight() const { return flight_; }

 private:
  void look_along(const Axis& n) {
    n_ = n;
    here_ = flight_.look(n);
  }

  // Whether the present axis separates, or one Newton step from it, or, sought from nothing, any.
  bool has_separating_axis() {
    if (here_.gap > 0) return true;
    look_along(detail::turned(n_, detail::clamped(here_.newton(), 1.0)));
    if (here_.gap > 0) return true;
    const auto [fresh, separates] = flight_.find_separating_axis();
    if (separates) look_along(fresh);
    return separates;
  }

  // A contact may be declared only with the best axis: near touching it is improved until the
  // possible gain is far below the contact gap.
  void perfect_axis() {
    for (int step = 0; step < 30 && !is_best_axis(); ++step)
      if (!flight_.climb(n_, here_)) break;
  }
  bool is_best_axis() const { return here_.gain() <= 1e-3 * contact_gap_; }

  // Whether the parabola that bounds the gap `g`, with `room` of it, stays positive for a duration
  // ahead or, negative, back: being concave, it is lowest at an end.
  bool is_open(const Gap& g, double room, double rate, double duration) const {
    const double bound = std::max(flight_.acceleration_bound(g, duration), 0.0);
    return room > 0 && room + duration * (rate - 0.5 * bound * duration) > 0;
  }

  // How the gap along the best axis closes. With C the curvature −∇∇g and m = d∇g/dt, that axis turns
  // at C⁻¹m, and its gap is g + ½ ∇g·C⁻¹∇g, its rate ġ + ∇g·C⁻¹m, its acceleration g̈ + m·C⁻¹m.
  // All but m multiplied by det C.
  using Step = decltype(std::declval<Gap>().newton());
  struct Approach {
    Step mixed;
    double room, rate, acceleration;  // room to the contact gap; −g̈
  };
  Approach approach(double rate) const {
    using detail::product;
    const double c = here_.determinant();
    const Step mixed = flight_.slope_rate(n_, here_);
    const Step pull = here_.adjugate(mixed);
    return {
        mixed,
        (here_.gap - contact_gap_) * c + 0.5 * product(here_.slope, here_.adjugate(here_.slope)),
        rate * c + product(here_.slope, pull),
        flight_.acceleration(here_) * c - product(mixed, pull)};
  }

  // Whether the gap, to second order, closes at a rate that is not lost on the way.
  bool crosses(double rate) const {
    constexpr double kept = 0.5;  // of the square of the rate
    const Approach a = approach(rate);
    const double lost = -2 * a.acceleration * a.room;
    return a.rate < 0 && lost < (1 - kept) * (a.rate * a.rate);
  }

  // Newton's method, of third order in time, for g = contact gap and dg/dφ = 0 in t and φ; then the
  // proof that the gap was open all the way. If it does not converge before `end`, or the proof
  // fails, nothing changes and the answer is false.
  bool leap(double rate, double end) {
    const double start = flight_.time(), start_rate = rate;
    const Axis start_axis = n_;
    const Gap start_gap = here_;
    for (int step = 0; step < 8; ++step) {
      const Approach a = approach(rate);
      const double closing = -1 / a.rate, inverse = 1 / here_.determinant();
      const double newton = a.room * closing;
      const double bend = 0.5 * a.acceleration * newton * closing;
      const double duration = newton * (1 - bend + 2 * bend * bend);
      const Step turn = here_.adjugate(here_.slope + a.mixed * duration) * inverse;
      if (!(flight_.time() + duration < end && detail::length(turn) < 1)) break;
      flight_.go_to(flight_.time() + duration);
      look_along(detail::turned(n_, turn));
      rate = flight_.gap_rate(n_, here_);
      if (!(rate < 0 && here_.is_concave())) break;
      const double error = std::abs(here_.gap - contact_gap_);
      if (error <= detail::leap_accuracy * contact_gap_ && is_best_axis()) {
        if (was_open(flight_.time() - start, rate, start_gap, start_rate)) return true;
        break;
      }
    }
    if (flight_.time() == start) return false;
    flight_.go_to(start);
    n_ = start_axis;
    here_ = start_gap;
    return false;
  }

  // Whether the gap was open for `duration` before now, at the beginning of which it was `then`: by
  // the parabola looking back from here, or by this for the later half and, for the earlier, the
  // parabola looking forward from there.
  bool was_open(double duration, double rate, const Gap& then, double then_rate) const {
    const double half = 0.5 * duration;
    return duration >= 0 && (is_open(here_, here_.gap, rate, -duration) ||
                             (is_open(here_, here_.gap, rate, -half) &&
                              is_open(then, then.gap - contact_gap_, then_rate, half)));
  }

  // A time in which the gap cannot fall below the contact gap.
  double safe_duration(double rate, double time_left) const {
    const double room = std::max(here_.gap - contact_gap_, 0.0);
    const double largest = flight_.largest_acceleration();
    // A guess, for a bound that need not hold longer.
    const double likely = std::max(flight_.acceleration(here_), largest / 16);
    double hoped = std::min(detail::first_root(room, rate, likely), time_left);
    hoped = std::min(hoped, flight_.doubling_time(here_.gap));
    const double bound = flight_.acceleration_bound(here_, hoped);
    const double safe = std::min(hoped, detail::first_root(room, rate, bound));
    if (here_.gap > detail::touching * contact_gap_ || largest == 0) return safe;
    // Sliding at the contact gap: time must pass, and the gap falls by an eighth of it at most.
    return std::max(safe, std::min(1.0, std::sqrt(0.25 * contact_gap_ / largest)));
  }

  // Goes on with the axis turned to where it will be best, as far as that can be foreseen.
  void advance(double duration) {
    const Step turn = here_.adjugate(here_.slope + flight_.slope_rate(n_, here_) * duration) /
                      here_.determinant();
    flight_.go_to(flight_.time() + duration);
    look_along(detail::turned(n_, detail::clamped(turn, 1.0)));
    has_separating_axis();
  }

  Found contact(int steps) {
    flight_.settle(n_, here_);
    return {Outcome::contact, steps};
  }

  PairInFlight flight_;
  double contact_gap_;
  Axis n_;    // the axis
  Gap here_;  // along it, now
};

}  // namespace vitrel
