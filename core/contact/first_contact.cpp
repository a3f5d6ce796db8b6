#include "core/contact/first_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/contact/support_gap.h"

namespace vitrel {

namespace {

constexpr int max_steps = 1000;
/// A gap up to this multiple of the contact gap counts as touching.
constexpr double touching = 1.25;

// First root of c + slope s − ½ M s² = 0 for c ≥ 0, M ≥ 0; infinity if there is none.
double first_root(double c, double slope, double acceleration) {
  const double root = std::sqrt(slope * slope + 2 * acceleration * c);
  if (slope < 0) return 2 * c / (root - slope);
  return acceleration > 0 ? (slope + root) / acceleration : std::numeric_limits<double>::infinity();
}

struct Interval {
  double begin, end;
  bool empty() const { return !(begin <= end); }
};

// The part of [0, horizon] in which the centres are closer than `reach`.
Interval time_within(const Vec2& d, const Vec2& v, double reach, double horizon) {
  const double distance = d.norm();
  const double c = (distance - reach) * (distance + reach);
  const double slope = d.dot(v);
  const double speed_squared = v.squaredNorm();
  if (c > 0 && slope >= 0) return {1, 0};
  if (speed_squared == 0) return c > 0 ? Interval{1, 0} : Interval{0, horizon};
  const double discriminant = slope * slope - speed_squared * c;
  if (discriminant < 0) return {1, 0};
  const double root = std::sqrt(discriminant);
  const double begin = c > 0 ? c / (root - slope) : 0;
  // The far root, in the form without cancellation.
  const double end = slope <= 0 ? (root - slope) / speed_squared : -c / (root + slope);
  return {begin, std::min(end, horizon)};
}

// The search for one pair; positions are relative to those at time 0.
class Search {
 public:
  Search(const Flight<Ellipse>& one, const Flight<Ellipse>& two, double contact_gap)
      : one_(one),
        two_(two),
        d0_(two.pose.position - one.pose.position),
        v_(two.motion.velocity - one.motion.velocity),
        contact_gap_(contact_gap) {}

  Prediction run(double horizon) {
    const double reach = one_.body.a + two_.body.a + touching * contact_gap_;
    const Interval near = time_within(d0_, v_, reach, horizon);
    if (near.empty()) return {};

    double time = near.begin;
    place(time);
    n_ = detail::find_separating_axis(one_.body, u1_, two_.body, u2_, d_);
    if (n_.isZero()) return {Outcome::overlap, time, Vec2::Zero(), Vec2::Zero(), 1};
    here_ = detail::gap_along(one_.body, u1_, two_.body, u2_, d_, n_);

    for (int step = 1; step <= max_steps; ++step) {
      sharpen_axis();
      const double slope = gap_rate();
      if (here_.gap <= touching * contact_gap_ && slope < 0) return contact(time, step);
      const double advance = safe_advance(slope, near.end - time);
      if (!(time + advance < near.end)) return {Outcome::none, 0, n_, Vec2::Zero(), step};
      time += advance;
      place(time);
      here_ = detail::gap_along(one_.body, u1_, two_.body, u2_, d_, n_);
    }
    return {Outcome::not_converged, time, n_, Vec2::Zero(), max_steps};
  }

 private:
  void place(double time) {
    d_ = d0_ + v_ * time;
    u1_ = direction(one_.pose.angle + one_.motion.angular_velocity * time);
    u2_ = direction(two_.pose.angle + two_.motion.angular_velocity * time);
  }

  // Any separating axis bounds, a better one bounds further; but a contact may be declared only
  // with the best one. The axis is improved while that promises a tenth of the gap, near touching
  // until the possible gain is far below the contact gap.
  void sharpen_axis() {
    const auto worth_it = [&] {
      if (!(here_.curvature > 0)) return true;
      if (here_.gap > 4 * contact_gap_) return here_.gain() > 0.1 * here_.gap;
      return here_.gain() > 1e-3 * contact_gap_;
    };
    for (int step = 0; step < 30 && worth_it(); ++step)
      if (!detail::climb(one_.body, u1_, two_.body, u2_, d_, n_, here_)) break;
    if (here_.curvature > 0 && here_.gap > 0) return;
    // The old axis has turned so far that Newton cannot climb from it: begin again.
    const Vec2 fresh = detail::find_separating_axis(one_.body, u1_, two_.body, u2_, d_);
    if (fresh.isZero()) return;
    n_ = fresh;
    here_ = detail::gap_along(one_.body, u1_, two_.body, u2_, d_, n_);
    for (int step = 0; step < 30 && worth_it(); ++step)
      if (!detail::climb(one_.body, u1_, two_.body, u2_, d_, n_, here_)) break;
  }

  // dg/dt for the fixed axis: n·v − ḣ₁ − ḣ₂, and turning the body by dθ is turning n by −dθ.
  double gap_rate() const {
    return n_.dot(v_) + one_.motion.angular_velocity * here_.slope1 +
           two_.motion.angular_velocity * here_.slope2;
  }

  double acceleration_bound(double duration) const {
    return support_acceleration_bound(one_.body, u1_, one_.motion.angular_velocity, n_, duration) +
           support_acceleration_bound(two_.body, u2_, two_.motion.angular_velocity, n_, duration);
  }

  // A time step in which the gap cannot fall below the contact gap.
  double safe_advance(double slope, double time_left) const {
    const double room = std::max(here_.gap - contact_gap_, 0.0);
    const double global = acceleration_bound(std::numeric_limits<double>::infinity());
    double advance = first_root(room, slope, global);
    // The bound over a shorter time is lower and may carry further, up to that time.
    const double trial = std::min(8 * advance, time_left);
    if (trial > advance) {
      const double local = first_root(room, slope, acceleration_bound(trial));
      advance = std::max(advance, std::min(local, trial));
    }
    if (here_.gap <= touching * contact_gap_ && global > 0)
      advance = std::max(advance, std::sqrt(0.25 * contact_gap_ / global));
    return advance;
  }

  Prediction contact(double time, int steps) {
    detail::settle(one_.body, u1_, two_.body, u2_, d_, n_, here_);
    const Vec2 centre = one_.pose.position + one_.motion.velocity * time;
    return {Outcome::contact, time, n_, centre + surface_point(one_.body, u1_, n_), steps};
  }

  const Flight<Ellipse>& one_;
  const Flight<Ellipse>& two_;
  const Vec2 d0_, v_;
  const double contact_gap_;
  Vec2 d_, u1_, u2_, n_;
  detail::GapAlongAxis here_;
};

Prediction circles(const Vec2& r1, const Vec2& v1, double radius1, const Vec2& r2, const Vec2& v2,
                   double radius2, double horizon, double contact_gap) {
  const Vec2 d = r2 - r1;
  const Vec2 v = v2 - v1;
  const double touch = radius1 + radius2;
  if (d.squaredNorm() < touch * touch) return {Outcome::overlap, 0, d.normalized(), r1, 1};
  if (d.dot(v) >= 0) return {};
  const Interval near = time_within(d, v, touch + contact_gap, horizon);
  if (near.empty()) return {};
  const Vec2 normal = (d + v * near.begin).normalized();
  return {Outcome::contact, near.begin, normal, r1 + v1 * near.begin + radius1 * normal, 1};
}

}  // namespace

double support_acceleration_bound(const Ellipse& ellipse, const Vec2& u, double omega,
                                  const Vec2& n, double duration) {
  const double stretch = (ellipse.a - ellipse.b) * (ellipse.a + ellipse.b);
  if (omega == 0 || stretch == 0) return 0;
  const double turn = std::abs(omega) * duration;
  double smallest = 0;  // of |u·n| over the step
  if (turn < 0.5 * std::numbers::pi) {
    const double cosine = std::abs(u.dot(n));
    const double sine = std::abs(cross(u, n));
    smallest = std::max(0.0, cosine * std::cos(turn) - sine * std::sin(turn));
  }
  const double h = std::sqrt(ellipse.b * ellipse.b + stretch * smallest * smallest);
  const double ab = ellipse.a * ellipse.b;
  return omega * omega * std::max(0.0, ab * ab / (h * h * h) - h);
}

Prediction first_contact(const Flight<Ellipse>& one, const Flight<Ellipse>& two, double horizon,
                         double contact_gap) {
  if (one.body.is_round() && two.body.is_round())
    return circles(one.pose.position, one.motion.velocity, one.body.a, two.pose.position,
                   two.motion.velocity, two.body.a, horizon, contact_gap);
  return Search(one, two, contact_gap).run(horizon);
}

Prediction first_contact(const Flight<Disk>& one, const Flight<Disk>& two, double horizon,
                         double contact_gap) {
  return circles(one.pose.position, one.motion.velocity, one.body.radius, two.pose.position,
                 two.motion.velocity, two.body.radius, horizon, contact_gap);
}

}  // namespace vitrel
