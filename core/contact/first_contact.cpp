#include "core/contact/first_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/pair_in_flight.h"
#include "core/contact/support_gap.h"

namespace vitrel {

namespace {

constexpr double forever = 1e100;
constexpr int max_steps = 1000;
/// A gap up to this multiple of the contact gap counts as touching.
constexpr double touching = 1.25;
/// A leap ends where the gap is the contact gap to within this fraction.
constexpr double leap_accuracy = 0.25;

// First root of c + slope s − ½ M s² = 0 for c ≥ 0 and any M; infinity if there is none.
double first_root(double c, double slope, double acceleration) {
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
constexpr Interval never{1, 0};

// A part of [0, horizon] outside which |d + v t| > reach + growth t: from the first moment at which
// this is not so to the last (or to the horizon, if the circles grow faster than they move).
Interval time_within(const Vec2& d, const Vec2& v, double reach, double growth, double horizon) {
  const double c = d.squaredNorm() - reach * reach;
  const double b = d.dot(v) - reach * growth;
  const double a = v.squaredNorm() - growth * growth;  // a t² + 2 b t + c ≤ 0 while within
  const double discriminant = b * b - a * c;
  const bool outside = c > 0;
  if (outside && discriminant < 0) return never;
  const double root = std::sqrt(std::max(discriminant, 0.0));
  if (outside && !(root - b > 0)) return never;
  const double begin = outside ? c / (root - b) : 0;
  if (!(a > 0)) return {begin, horizon};
  // The far root, in the form without cancellation.
  const double end = b <= 0 ? (root - b) / a : -c / (root + b);
  return {begin, std::min(end, horizon)};
}

// The search for one pair.
template <class B>
class Search {
 public:
  Search(const Flight<B>& one, const Flight<B>& two, double contact_gap)
      : flight_(one, two), contact_gap_(contact_gap) {}

  /// All but the contact point. Flattened, since calls weigh in so short a search.
  [[gnu::flatten]] Prediction run(double horizon, const Vec2* likely_axis) {
    const Interval near =
        time_within(flight_.d0(), flight_.v(), flight_.reach() + touching * contact_gap_,
                    flight_.reach_growth(), std::min(horizon, forever));
    if (near.empty()) return {};
    flight_.start_at(near.begin);
    look_along(likely_axis ? *likely_axis : detail::likely_axis(flight_.now()));
    if (!has_separating_axis()) return outcome(Outcome::overlap, 1);

    for (int step = 1; step <= max_steps; ++step) {
      if (here_.gap <= 4 * contact_gap_) perfect_axis();
      const double rate = flight_.gap_rate(n_, here_);
      const double room = here_.gap - contact_gap_;
      const double time_left = near.end - flight_.time();
      if (here_.gap <= touching * contact_gap_ && rate < 0) return contact(step);
      if (time_left <= 0) return outcome(Outcome::none, step);
      if (room + rate * time_left > 0) {
        if (is_open(here_, room, rate, time_left)) return outcome(Outcome::none, step);
      } else if (room > 0 && crosses(rate) && leap(rate, near.end)) {
        return contact(step);
      }
      const double duration = safe_duration(rate, time_left);
      // Closing so fast that no double lies between now and the contact.
      if (rate < 0 && flight_.time() + duration == flight_.time()) return contact(step);
      advance(duration);
    }
    return outcome(Outcome::not_converged, max_steps);
  }

  /// From centre 1 to its surface point with normal n.
  Vec2 arm1() const {
    const EllipsePair& pair = flight_.now();
    const Vec2 u(pair.ux[0], pair.uy[0]);
    const double along = u.dot(n_);
    const double h = std::sqrt(pair.bb[0] + pair.stretch[0] * along * along);
    return pair.size[0] / h * (pair.bb[0] * n_ + pair.stretch[0] * along * u);
  }

 private:
  void look_along(const Vec2& n) {
    n_ = n;
    here_ = gap_along<PairInFlight<B>::grows>(flight_.now(), n);
  }

  // Whether the present axis separates, or one Newton step from it, or, sought from nothing, any.
  bool has_separating_axis() {
    if (here_.gap > 0) return true;
    look_along(detail::turned(n_, std::clamp(here_.slope / here_.curvature, -1.0, 1.0)));
    if (here_.gap > 0) return true;
    const auto [fresh, separates] = detail::find_separating_axis(flight_.now());
    if (separates) look_along(fresh);
    return separates;
  }

  // A contact may be declared only with the best axis: near touching it is improved until the
  // possible gain is far below the contact gap.
  void perfect_axis() {
    for (int step = 0; step < 30 && !is_best_axis(); ++step)
      if (!detail::climb(flight_.now(), n_, here_)) break;
  }
  bool is_best_axis() const { return here_.gain() <= 1e-3 * contact_gap_; }

  // Whether the parabola that bounds the gap `g`, with `room` of it, stays positive for a duration
  // ahead or, negative, back: being concave, it is lowest at an end.
  bool is_open(const GapAlongAxis& g, double room, double rate, double duration) const {
    const double bound = std::max(flight_.acceleration_bound(g, duration), 0.0);
    return room > 0 && room + duration * (rate - 0.5 * bound * duration) > 0;
  }

  // How the gap along the best axis closes. With c the curvature, −d²g/dφ², and m = d²g/dφdt, that
  // axis turns at m/c, and its gap is g + g'²/2c, its rate ġ + g'm/c, its acceleration g̈ + m²/c.
  // All but m multiplied by c.
  struct Approach {
    double mixed, room, rate, acceleration;  // room to the contact gap; −g̈
  };
  Approach approach(double rate) const {
    const double c = here_.curvature;
    const double mixed = flight_.slope_rate(n_, here_);
    return {mixed, (here_.gap - contact_gap_) * c + 0.5 * here_.slope * here_.slope,
            rate * c + here_.slope * mixed, flight_.acceleration(here_) * c - mixed * mixed};
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
    const Vec2 start_axis = n_;
    const GapAlongAxis start_gap = here_;
    for (int step = 0; step < 8; ++step) {
      const Approach a = approach(rate);
      const double closing = -1 / a.rate, inverse = 1 / here_.curvature;
      const double newton = a.room * closing;
      const double bend = 0.5 * a.acceleration * newton * closing;
      const double duration = newton * (1 - bend + 2 * bend * bend);
      const double turn = (here_.slope + a.mixed * duration) * inverse;
      if (!(flight_.time() + duration < end && std::abs(turn) < 1)) break;
      flight_.go_to(flight_.time() + duration);
      look_along(detail::turned(n_, turn));
      rate = flight_.gap_rate(n_, here_);
      if (!(rate < 0 && here_.curvature > 0)) break;
      const double error = std::abs(here_.gap - contact_gap_);
      if (error <= leap_accuracy * contact_gap_ && is_best_axis()) {
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
  bool was_open(double duration, double rate, const GapAlongAxis& then, double then_rate) const {
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
    double hoped = std::min(first_root(room, rate, likely), time_left);
    hoped = std::min(hoped, flight_.doubling_time(here_.gap));
    const double bound = flight_.acceleration_bound(here_, hoped);
    const double safe = std::min(hoped, first_root(room, rate, bound));
    if (here_.gap > touching * contact_gap_ || largest == 0) return safe;
    // Sliding at the contact gap: time must pass, and the gap falls by an eighth of it at most.
    return std::max(safe, std::min(1.0, std::sqrt(0.25 * contact_gap_ / largest)));
  }

  // Goes on with the axis turned to where it will be best, as far as that can be foreseen.
  void advance(double duration) {
    const double turn = (here_.slope + flight_.slope_rate(n_, here_) * duration) / here_.curvature;
    flight_.go_to(flight_.time() + duration);
    look_along(detail::turned(n_, std::clamp(turn, -1.0, 1.0)));
    has_separating_axis();
  }

  Prediction outcome(Outcome what, int steps) const {
    return {what, flight_.time(), n_, Vec2::Zero(), steps};
  }
  Prediction contact(int steps) {
    detail::settle(flight_.now(), n_, here_);
    return outcome(Outcome::contact, steps);
  }

  PairInFlight<B> flight_;
  double contact_gap_;
  Vec2 n_;             // the axis
  GapAlongAxis here_;  // along it, now
};

template <class B>
Prediction search(const Flight<B>& one, const Flight<B>& two, double horizon, double contact_gap,
                  const Vec2* likely_axis) {
  Search<B> pair(one, two, contact_gap);
  Prediction found = pair.run(horizon, likely_axis);
  if (found.outcome == Outcome::contact)
    found.point = one.pose.position + one.motion.velocity * found.time + pair.arm1();
  return found;
}

struct Circle {
  double radius, growth;
};

template <class B>
Prediction circles(const Flight<B>& one, const Circle& circle1, const Flight<B>& two,
                   const Circle& circle2, double horizon, double contact_gap) {
  const Vec2 d = two.pose.position - one.pose.position;
  const Vec2 v = two.motion.velocity - one.motion.velocity;
  const double touch = circle1.radius + circle2.radius;
  if (d.squaredNorm() < touch * touch)
    return {Outcome::overlap, 0, d.normalized(), one.pose.position, 1};
  const double reach = touch + contact_gap;
  const double growth = circle1.growth + circle2.growth;
  const double distance = d.norm();
  const double c = (distance - reach) * (distance + reach);
  const double b = d.dot(v) - reach * growth;
  const double a = v.squaredNorm() - growth * growth;  // a t² + 2 b t + c ≤ 0 while within reach
  const double discriminant = b * b - a * c;
  if (b >= 0 && a >= 0) return {};
  if (c > 0 && discriminant < 0) return {};
  const double root = std::sqrt(std::max(discriminant, 0.0));
  const double time = b < 0 ? std::max(c / (root - b), 0.0) : (b + root) / -a;
  if (!(time <= horizon)) return {};
  const Vec2 normal = (d + v * time).normalized();
  const double radius1 = circle1.radius + circle1.growth * time;
  return {Outcome::contact, time, normal,
          one.pose.position + one.motion.velocity * time + radius1 * normal, 1};
}

bool are_round(const Flight<Ellipse>& one, const Flight<Ellipse>& two) {
  return one.body.is_round() && two.body.is_round();
}
bool are_round(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two) {
  return one.body.shape.is_round() && two.body.shape.is_round();
}

Circle circle(const Ellipse& body) {
  return {body.a, 0};
}
Circle circle(const GrowingEllipse& body) {
  return {body.circumradius(), body.growth_rate * body.shape.a};
}

template <class B>
Prediction meet(const Flight<B>& one, const Flight<B>& two, double horizon, double contact_gap,
                const Vec2* likely_axis) {
  if (are_round(one, two))
    return circles(one, circle(one.body), two, circle(two.body), horizon, contact_gap);
  return search(one, two, horizon, contact_gap, likely_axis);
}

}  // namespace

Prediction first_contact(const Flight<Ellipse>& one, const Flight<Ellipse>& two, double horizon,
                         double contact_gap) {
  return meet(one, two, horizon, contact_gap, nullptr);
}

Prediction first_contact(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two,
                         double horizon, double contact_gap) {
  return meet(one, two, horizon, contact_gap, nullptr);
}

Prediction first_contact(const Flight<Ellipse>& one, const Flight<Ellipse>& two, double horizon,
                         double contact_gap, const Vec2& likely_axis) {
  return meet(one, two, horizon, contact_gap, &likely_axis);
}

Prediction first_contact(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two,
                         double horizon, double contact_gap, const Vec2& likely_axis) {
  return meet(one, two, horizon, contact_gap, &likely_axis);
}

Prediction first_contact(const Flight<Disk>& one, const Flight<Disk>& two, double horizon,
                         double contact_gap) {
  return circles(one, {one.body.radius, 0}, two, {two.body.radius, 0}, horizon, contact_gap);
}

}  // namespace vitrel
