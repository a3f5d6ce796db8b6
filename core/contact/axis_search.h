#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contact/ellipse_gap.h"
#include "core/contact/ellipsoid_gap.h"
#include "core/contact/first_contact.h"
#include "core/contact/first_root.h"

namespace vitrel {

namespace detail {

constexpr double max_time = 1e100;
constexpr int max_steps = 1000;
/// A gap of up to this multiple of the contact gap counts as touching.
constexpr double touching = 1.25;
/// The Newton iteration ends where the gap is the contact gap to within this fraction.
constexpr double newton_tolerance = 0.25;

struct Interval {
  double begin, end;
  bool empty() const { return !(begin <= end); }
};
constexpr Interval empty_interval{1, 0};

// Returns an interval within [0, horizon] outside which |d + v t| > reach + growth t. It lasts from the first time at
// which the circles touch to the last, or to the horizon if they grow faster than they move apart.
template <int Dim>
Interval time_within(const Vec<Dim>& d, const Vec<Dim>& v, double reach, double growth,
                     double horizon) {
  const double c = squared_norm(d) - reach * reach;
  const double b = dot(d, v) - reach * growth;
  const double a = squared_norm(v) - growth * growth;  // a t² + 2 b t + c ≤ 0 while within
  const double discriminant = b * b - a * c;
  const bool outside = c > 0;
  if (outside && discriminant < 0) return empty_interval;
  const double root = std::sqrt(std::max(discriminant, 0.0));
  if (outside && !(root - b > 0)) return empty_interval;
  const double begin = outside ? c / (root - b) : 0;
  if (!(a > 0)) return {begin, horizon};
  // This is the second root, without cancellation.
  const double end = b <= 0 ? (root - b) / a : -c / (root + b);
  return {begin, std::min(end, horizon)};
}

}  // namespace detail

/// The contact search for one pair by the steps of first_contact.h, in either dimension. An axis is rotated by steps in
/// its tangent plane, which are one number in two dimensions and two in three.
template <class PairInFlight>
class AxisSearch {
  using Axis = typename PairInFlight::Axis;
  using Gap = typename PairInFlight::Gap;

 public:
  template <Body B>
  AxisSearch(const Flight<B>& one, const Flight<B>& two, double contact_gap)
      : flight_(one, two), contact_gap_(contact_gap) {}

  struct Result {
    Outcome outcome;
    int steps;
  };

  /// Searches from `begin`, up to which the bodies are known to be disjoint, to the horizon. The function is flattened
  /// because the search is so short that calls would dominate.
  VITREL_FLATTEN Result run(double begin, double horizon, const Axis* initial_axis) {
    const double end = std::min(horizon, detail::max_time);
    // The bodies of a pair that was screened are usually near each other at once.
    const detail::Interval near =
        begin > 0 ? detail::Interval{0, end}
                  : detail::time_within(flight_.d0(), flight_.v(),
                                        flight_.reach() + detail::touching * contact_gap_,
                                        flight_.reach_growth(), end);
    if (near.empty() || begin > near.end) return {Outcome::none, 0};
    flight_.start_at(std::max(begin, near.begin));
    set_axis(initial_axis ? *initial_axis : flight_.initial_axis());
    // At `begin` the pair may be closer than the contact gap.
    if (begin > near.begin && here_.gap < contact_gap_) {
      flight_.start_at(near.begin);
      set_axis(n_);
    }
    if (!has_separating_axis()) return Result{Outcome::overlap, 1};

    for (int step = 1; step <= detail::max_steps; ++step) {
      if (here_.gap <= 4 * contact_gap_) optimize_axis();
      const double rate = flight_.gap_rate(n_, here_);
      const double margin = here_.gap - contact_gap_;
      const double time_left = near.end - flight_.time();
      if (here_.gap <= detail::touching * contact_gap_ && rate < 0) return contact(step);
      if (time_left <= 0) return Result{Outcome::none, step};
      if (margin + rate * time_left > 0) {
        if (stays_open(here_, margin, rate, time_left)) return Result{Outcome::none, step};
      } else if (margin > 0 && crosses(rate) && newton_to_contact(rate, near.end)) {
        return contact(step);
      }
      const double duration = safe_duration(rate, time_left);
      // If time does not advance, the gap closes so fast that no double lies between now and the contact.
      if (rate < 0 && flight_.time() + duration == flight_.time()) return contact(step);
      advance(duration);
    }
    return Result{Outcome::not_converged, detail::max_steps};
  }

  double time() const { return flight_.time(); }
  const Axis& axis() const { return n_; }
  const PairInFlight& flight() const { return flight_; }

 private:
  void set_axis(const Axis& n) {
    n_ = n;
    here_ = flight_.evaluate(n);
  }

  // Tries the current axis, one Newton step from it, and then any axis at all. Returns whether the bodies are
  // separated.
  bool has_separating_axis() {
    if (here_.gap > 0) return true;
    set_axis(detail::turned(n_, detail::clamped(here_.newton(), 1.0)));
    if (here_.gap > 0) return true;
    const auto [new_axis, separates] = flight_.find_separating_axis();
    if (separates) set_axis(new_axis);
    return separates;
  }

  // Only the best axis may declare a contact: near touching, the axis is improved until the possible gain is far below
  // the contact gap.
  void optimize_axis() {
    for (int step = 0; step < 30 && !is_best_axis(); ++step)
      if (!flight_.improve_axis(n_, here_)) break;
  }
  bool is_best_axis() const { return here_.gain() <= 1e-3 * contact_gap_; }

  // Returns whether the parabola that bounds the gap `g` from below stays positive for `duration`, which may be
  // negative (backwards). The parabola starts `margin` above zero. It is concave, so its minimum is at an end.
  bool stays_open(const Gap& g, double margin, double rate, double duration) const {
    const double bound = std::max(flight_.acceleration_bound(g, duration), 0.0);
    return margin > 0 && margin + duration * (rate - 0.5 * bound * duration) > 0;
  }

  // The gap along the best axis as a function of time. With C = −∇∇g and m = d∇g/dt, the best axis rotates at
  // C⁻¹m; its gap is g + ½ ∇g·C⁻¹∇g, its rate ġ + ∇g·C⁻¹m and its acceleration g̈ + m·C⁻¹m. All values but m
  // are multiplied by det C.
  using Step = decltype(std::declval<Gap>().newton());
  struct Approach {
    Step mixed;
    double margin, rate, acceleration;  // margin to the contact gap, rate, −g̈
  };
  Approach approach(double rate) const {
    const double c = here_.determinant();
    const Step mixed = flight_.slope_rate(n_, here_);
    const Step pull = here_.adjugate(mixed);
    return {mixed,
            (here_.gap - contact_gap_) * c + 0.5 * dot(here_.slope, here_.adjugate(here_.slope)),
            rate * c + dot(here_.slope, pull), flight_.acceleration(here_) * c - dot(mixed, pull)};
  }

  // Returns whether the gap, to second order, reaches zero with at least half of the square of its rate.
  bool crosses(double rate) const {
    constexpr double kept = 0.5;  // fraction of the squared rate
    const Approach a = approach(rate);
    const double lost = -2 * a.acceleration * a.margin;
    return a.rate < 0 && lost < (1 - kept) * (a.rate * a.rate);
  }

  // Solves g = contact gap and dg/dφ = 0 for t and φ by a Newton iteration of third order in time, and then proves that
  // the gap was open all the way. If the iteration does not converge before `end`, or the proof fails, it restores the
  // state and returns false.
  bool newton_to_contact(double rate, double end) {
    const double start = flight_.time(), start_rate = rate;
    const Axis start_axis = n_;
    const Gap start_gap = here_;
    for (int step = 0; step < 8; ++step) {
      const Approach a = approach(rate);
      const double closing = -1 / a.rate, inverse = 1 / here_.determinant();
      const double newton = a.margin * closing;
      const double correction = 0.5 * a.acceleration * newton * closing;
      const double duration = newton * (1 - correction + 2 * correction * correction);
      const Step rotation = here_.adjugate(here_.slope + a.mixed * duration) * inverse;
      if (!(flight_.time() + duration < end && norm(rotation) < 1)) break;
      flight_.go_to(flight_.time() + duration);
      set_axis(detail::turned(n_, rotation));
      rate = flight_.gap_rate(n_, here_);
      if (!(rate < 0 && here_.is_concave())) break;
      const double error = std::abs(here_.gap - contact_gap_);
      if (error <= detail::newton_tolerance * contact_gap_ && is_best_axis()) {
        if (stayed_open(flight_.time() - start, rate, start_gap, start_rate)) return true;
        break;
      }
    }
    if (flight_.time() == start) return false;
    flight_.go_to(start);
    n_ = start_axis;
    here_ = start_gap;
    return false;
  }

  // Returns whether the gap was open during the last `duration`, at whose start it was `then`. The backward parabola
  // from the present time proves it, or this parabola for the later half and the forward parabola for the earlier half.
  bool stayed_open(double duration, double rate, const Gap& then, double then_rate) const {
    const double half = 0.5 * duration;
    return duration >= 0 && (stays_open(here_, here_.gap, rate, -duration) ||
                             (stays_open(here_, here_.gap, rate, -half) &&
                              stays_open(then, then.gap - contact_gap_, then_rate, half)));
  }

  // Returns a time step in which the gap cannot fall below the contact gap.
  double safe_duration(double rate, double time_left) const {
    const double margin = std::max(here_.gap - contact_gap_, 0.0);
    const double largest = flight_.largest_acceleration();
    // The trial step uses an estimate; the bound computed then holds for this step only.
    const double estimated = std::max(flight_.acceleration(here_), largest / 16);
    double trial = std::min(detail::first_root(margin, rate, estimated), time_left);
    trial = std::min(trial, flight_.doubling_time(here_.gap));
    const double bound = flight_.acceleration_bound(here_, trial);
    const double safe = std::min(trial, detail::first_root(margin, rate, bound));
    if (here_.gap > detail::touching * contact_gap_ || largest == 0) return safe;
    // The pair slides at the contact gap: time must advance, and the gap falls by at most an eighth of it.
    return std::max(safe, std::min(flight_.short_time(), std::sqrt(0.25 * contact_gap_ / largest)));
  }

  // Advances by `duration` and rotates the axis to its predicted optimum.
  void advance(double duration) {
    const Step rotation = here_.adjugate(here_.slope + flight_.slope_rate(n_, here_) * duration) /
                          here_.determinant();
    flight_.go_to(flight_.time() + duration);
    set_axis(detail::turned(n_, detail::clamped(rotation, 1.0)));
    has_separating_axis();
  }

  Result contact(int steps) {
    flight_.polish_axis(n_, here_);
    return {Outcome::contact, steps};
  }

  PairInFlight flight_;
  double contact_gap_;
  Axis n_;
  Gap here_;  // the gap along n_ at the present time
};

}  // namespace vitrel
