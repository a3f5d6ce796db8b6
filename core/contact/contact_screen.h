#pragma once

#include <concepts>
#include <limits>

#include "core/contact/first_contact.h"
#include "core/contact/several.h"

/// One body and several partners at one instant: until when is contact surely impossible?
///
/// Most of the pairs that an event-driven run asks about do not touch before something else
/// happens. The first look settles these, `many` at a time, by one parabola each,
///     g(n, t + s) ≥ g + ġ s − ½ M s²   (first_contact.h),
/// along an axis n remembered from the last look at the pair; every look turns it by a step of
/// Newton's method towards the best. Disks need no axis: their time is that of contact, in closed
/// form.
namespace vitrel {

/// The size of all bodies alike, and its rate of growth.
struct CommonSize {
  double size = 1;
  double growth_rate = 0;
};

namespace detail {

constexpr double no_contact = std::numeric_limits<double>::infinity();

/// A time for every lane, and which comes first.
template <int lanes>
class Urgencies {
 public:
  struct Urgent {
    double time;
    int lane;
  };
  Urgent most_urgent() const {
    const double time = hmin(open_until_);
    return {time, find_first_set(open_until_ == time)};
  }
  /// Nothing more is to be known of this lane.
  void close(int lane) {
    where(lane_numbers<lanes> == lane, open_until_) = Simd<lanes>(no_contact);
  }

 protected:
  /// The times of the first `count` lanes.
  VITREL_INLINE void open(const Simd<lanes>& until, int count) {
    open_until_ = until;
    where(lane_numbers<lanes> >= count, open_until_) = Simd<lanes>(no_contact);
  }

 private:
  Simd<lanes> open_until_;
};

/// The first root of room + rate s − ½ M s², or infinity if it lies beyond the horizon.
VITREL_INLINE Many first_root(const Many& room, const Many& rate, const Many& bend,
                              const Many& horizon) {
  constexpr double nearly_straight = 1e-300;
  const Many acceleration = max(bend, Many(nearly_straight));
  const Many root = sqrt(rate * rate + 2. * acceleration * max(room, Many(0)));
  Many time = 2. * room / (root - rate);
  where(rate > 0, time) = (rate + root) / acceleration;
  const Many end = room + horizon * (rate - 0.5 * acceleration * horizon);
  where(end > 0, time) = Many(no_contact);
  where(!(room > 0), time) = Many(0);
  return time;
}

}  // namespace detail

/// A look of a body at up to `lanes` partners. A body that grows is `Grown<B>` times the common size.
template <Body B>
class FirstLook;

template <Body B>
requires std::same_as<Grown<B>, Ellipse>
class FirstLook<B> : public detail::Urgencies<many> {
  /// A gap that stays above this fraction of the contact gap stays open. It lets a pair that has
  /// just collided, and leaves, be settled too.
  static constexpr double open_gap = 0.5;

 public:
  static constexpr int lanes = many;
  /// Whether open_until is the time of contact if it is not 0.
  static constexpr bool is_exact = false;
  /// What is remembered of a pair from one look to the next.
  struct Memory {
    Vec2 axis;
    /// Of the same pair, seen from the other body.
    friend Memory reversed(const Memory& memory) { return {-memory.axis}; }
  };

  FirstLook(const Outline<Ellipse>& outline, const Pose2& pose, const Motion2& motion,
            const CommonSize& common, double contact_gap)
      : outline_(outline), motion_(motion), common_(common), floor_(open_gap * contact_gap) {
    Lanes x, y;
    directions<Lanes>({pose.angle, pose.angle}, x, y);
    ux_ = x[0];
    uy_ = y[0];
  }

  /// Puts a partner into a lane: its pose, relative to this body's centre, and motion now, and how
  /// far to look ahead.
  VITREL_INLINE void set(int k, const Pose2& pose, const Motion2& motion,
                         const Outline<Ellipse>& outline, const Memory& memory, double horizon) {
    dx_[k] = pose.position.x();
    dy_[k] = pose.position.y();
    vx_[k] = motion.velocity.x() - motion_.velocity.x();
    vy_[k] = motion.velocity.y() - motion_.velocity.y();
    angle_[k] = pose.angle;
    omega_[k] = motion.angular_velocity;
    bb_[k] = outline.bb;
    stretch_[k] = outline.stretch;
    aabb_[k] = outline.aabb;
    bend_[k] = outline.bend;
    nx_[k] = memory.axis.x();
    ny_[k] = memory.axis.y();
    horizon_[k] = horizon;
  }
  Memory memory(int k) const { return {{nx_[k], ny_[k]}}; }

  /// Finds, for each of the first `count` lanes, a time before which there can be no contact:
  /// infinite if there is none up to the horizon, 0 if the axis separates nothing. Turns the axes.
  [[gnu::flatten]] void look(int count) {
    const Many nx = nx_.all(), ny = ny_.all(), dx = dx_.all(), dy = dy_.all();
    const Many bb = bb_.all(), stretch = stretch_.all(), omega2 = omega_.all();
    const Many omega1 = motion_.angular_velocity, horizon = horizon_.all();
    Many ux, uy;
    directions<Many>(angle_.all(), ux, uy);
    const auto one =
        support_along<Many>(outline_.bb, outline_.stretch, outline_.aabb, ux_, uy_, nx, ny);
    const auto two = support_along<Many>(bb, stretch, aabb_.all(), ux, uy, nx, ny);
    const Many heights = one.height + two.height;
    const Many spin = omega1 * one.turning + omega2 * two.turning;
    const Many gap = nx * dx + ny * dy - sized(heights);
    Many rate = nx * vx_.all() + ny * vy_.all() + sized(spin);
    Many bend = bend_bound<Many>(one, outline_.bb, outline_.stretch, omega1,
                                 omega1 * omega1 * outline_.bend, horizon) +
                bend_bound<Many>(two, bb, stretch, omega2, omega2 * omega2 * bend_.all(), horizon);
    if constexpr (grows<B>) {
      const double growth = common_.growth_rate;
      rate -= growth * heights;
      bend = common_.size * bend + std::abs(growth) * horizon * abs(bend) - 2 * growth * spin;
    }
    open(detail::first_root(gap - floor_, rate, bend, horizon), count);
    Many turned_nx = nx, turned_ny = ny;
    detail::turn(turned_nx, turned_ny, nx * dy - ny * dx - sized(one.turning + two.turning),
                 gap + sized(one.radius + two.radius));
    nx_.store(turned_nx);
    ny_.store(turned_ny);
  }

 private:
  VITREL_INLINE Many sized(const Many& x) const {
    if constexpr (grows<B>) return common_.size * x;
    return x;
  }

  using Numbers = detail::NumbersOf<many>;

  Outline<Ellipse> outline_;
  Motion2 motion_;
  CommonSize common_;
  double floor_;
  double ux_, uy_;
  Numbers dx_, dy_, vx_, vy_, angle_, omega_, bb_, stretch_, aabb_, bend_, nx_, ny_, horizon_;
};

/// Disks and spheres: in closed form.
template <Body B>
requires std::same_as<Grown<B>, Disk> || std::same_as<Grown<B>, Sphere>
class FirstLook<B> : public detail::Urgencies<8> {
  static constexpr int dimension = B::dimension;

 public:
  static constexpr int lanes = 8;
  static constexpr bool is_exact = true;
  struct Memory {
    Memory() = default;
    explicit(false) Memory(const Vec<dimension>& /*axis*/) {}
    friend Memory reversed(const Memory& memory) { return memory; }
  };

  FirstLook(const Outline<Grown<B>>& outline, const Pose<dimension>& /*pose*/,
            const Motion<dimension>& motion, const CommonSize& common, double contact_gap)
      : radius_(outline.radius),
        velocity_(motion.velocity),
        common_(common),
        contact_gap_(contact_gap) {}

  VITREL_INLINE void set(int k, const Pose<dimension>& pose, const Motion<dimension>& motion,
                         const Outline<Grown<B>>& outline, const Memory&, double horizon) {
    for (int x = 0; x < dimension; ++x) {
      d_[x][k] = pose.position[x];
      v_[x][k] = motion.velocity[x] - velocity_[x];
    }
    other_radius_[k] = outline.radius;
    horizon_[k] = horizon;
  }
  Memory memory(int) const { return {}; }

  /// Finds the times of contact: infinite without, 0 for approaching pairs that touch or overlap.
  [[gnu::flatten]] void look(int count) {
    using Simd = detail::Simd<lanes>;
    const Simd radii = other_radius_.all() + radius_;
    Simd reach = radii + contact_gap_;
    if constexpr (grows<B>) reach = common_.size * radii + contact_gap_;
    const Simd c = product(d_, d_) - reach * reach;
    Simd b = product(d_, v_), a = product(v_, v_);
    if constexpr (grows<B>) {
      const Simd growth = common_.growth_rate * radii;
      b -= reach * growth;
      a -= growth * growth;
    }
    const Simd discriminant = b * b - a * c;
    const Simd root = sqrt(max(discriminant, Simd(0)));
    Simd time = max(c / (root - b), Simd(0));
    auto misses = !(b < 0);
    if constexpr (grows<B>) {
      // Moving apart, but growing faster.
      where(misses && a < 0, time) = max((b + root) / -a, Simd(0));
      misses = misses && !(a < 0);
    }
    where(misses || !(discriminant >= 0) || !(time < horizon_.all()), time) =
        Simd(detail::no_contact);
    open(time, count);
  }

 private:
  using Numbers = detail::NumbersOf<lanes>;

  VITREL_INLINE static detail::Simd<lanes> product(const Numbers (&u)[dimension],
                                                   const Numbers (&v)[dimension]) {
    detail::Simd<lanes> sum = u[0].all() * v[0].all() + u[1].all() * v[1].all();
    if constexpr (dimension == 3) sum += u[2].all() * v[2].all();
    return sum;
  }

  double radius_;
  Vec<dimension> velocity_;
  CommonSize common_;
  double contact_gap_;
  Numbers d_[dimension], v_[dimension], other_radius_, horizon_;
};

/// first_contact, beginning with what a look remembered.
template <Body B>
Prediction<B::dimension> first_contact(const Flight<B>& one, const Flight<B>& two, double horizon,
                                       double contact_gap,
                                       const typename FirstLook<B>::Memory& memory) {
  if constexpr (FirstLook<B>::is_exact)
    return first_contact(one, two, horizon, contact_gap);
  else
    return first_contact(one, two, horizon, contact_gap, memory.axis);
}

}  // namespace vitrel
