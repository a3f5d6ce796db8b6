#pragma once

#include <limits>
#include <type_traits>

#include "core/contact/ellipse_pair.h"
#include "core/contact/first_contact.h"
#include "core/geometry/disk.h"

/// One body and several partners at one instant: until when is contact surely impossible?
///
/// Most of the pairs that an event-driven run asks about do not touch before something else
/// happens. The first look settles these, `many` at a time, by one parabola each,
///     g(n, t + s) ≥ g + ġ s − ½ M s²   (first_contact.h),
/// along an axis n remembered from the last look at the pair; every look turns it by a step of
/// Newton's method towards the best. Disks need no axis: their time is that of contact, in closed
/// form.
namespace vitrel {

/// What a look needs to know of a shape (at size 1).
template <class Shape>
struct Outline;

template <>
struct Outline<Disk> {
  double radius = 1;
  explicit Outline(const Disk& disk) : radius(disk.radius) {}
};

template <>
struct Outline<Ellipse> {
  double bb, stretch, aabb;  ///< b², a² − b², a² b²
  double bend;               ///< (a² − b²)/b, the largest h''
  explicit Outline(const Ellipse& ellipse)
      : bb(ellipse.b * ellipse.b),
        stretch(ellipse.stretch()),
        aabb(ellipse.a * ellipse.a * bb),
        bend(stretch / ellipse.b) {}
};

/// The size of all bodies alike, and its rate of growth.
struct CommonSize {
  double size = 1;
  double growth_rate = 0;
};

namespace detail {

template <int lanes>
using Simd = std::experimental::fixed_size_simd<double, lanes>;

/// One number of each of several pairs, filled one by one.
template <int lanes>
struct NumbersOf {
  alignas(std::experimental::memory_alignment_v<Simd<lanes>>) double lane[lanes] = {};
  double& operator[](int k) { return lane[k]; }
  double operator[](int k) const { return lane[k]; }
  Simd<lanes> all() const { return {lane, std::experimental::vector_aligned}; }
  void store(const Simd<lanes>& x) { x.copy_to(lane, std::experimental::vector_aligned); }
};

constexpr double no_contact = std::numeric_limits<double>::infinity();

/// What all looks have: a time for every lane.
template <int lanes>
class Urgencies {
 public:
  double open_until(int k) const { return open_until_[k]; }
  /// The lane that is open for the shortest time.
  int most_urgent() const {
    const auto times = open_until_.all();
    return find_first_set(times == hmin(times));
  }
  /// Nothing more is to be known of this lane.
  void close(int k) { open_until_[k] = no_contact; }

 protected:
  void close_from(int k) {
    for (; k < lanes; ++k) close(k);
  }

  NumbersOf<lanes> open_until_;
};

}  // namespace detail

/// A look of a body at up to `lanes` partners. The body of a `GrowingEllipse` is `Shape` times the
/// common size.
template <class B>
class FirstLook : public detail::Urgencies<many> {
  static constexpr bool grows = std::is_same_v<B, GrowingEllipse>;
  /// A gap that stays above this fraction of the contact gap stays open. It lets a pair that has
  /// just collided, and leaves, be settled too.
  static constexpr double open_gap = 0.5;

 public:
  using Shape = Ellipse;
  static constexpr int lanes = many;
  /// Whether open_until is the time of contact if it is not 0.
  static constexpr bool is_exact = false;
  /// What is remembered of a pair from one look to the next.
  struct Memory {
    Vec2 axis;
  };

  FirstLook(const Outline<Shape>& outline, const Pose2& pose, const Motion2& motion,
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
                         const Outline<Shape>& outline, const Memory& memory, double horizon) {
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
    const auto one = support_along<Many>(outline_.bb, outline_.stretch, outline_.aabb, ux_, uy_, nx, ny);
    const auto two = support_along<Many>(bb, stretch, aabb_.all(), ux, uy, nx, ny);
    const Many heights = one.height + two.height;
    const Many spin = omega1 * one.turning + omega2 * two.turning;
    const Many gap = nx * dx + ny * dy - sized(heights);
    Many rate = nx * vx_.all() + ny * vy_.all() + sized(spin);
    Many bend = bend_bound<Many>(one, outline_.bb, outline_.stretch, omega1,
                                 omega1 * omega1 * outline_.bend, horizon) +
                bend_bound<Many>(two, bb, stretch, omega2, omega2 * omega2 * bend_.all(), horizon);
    if constexpr (grows) {
      const double growth = common_.growth_rate;
      rate -= growth * heights;
      bend = common_.size * bend + std::abs(growth) * horizon * abs(bend) - 2 * growth * spin;
    }
    open_until_.store(first_root(gap - floor_, rate, bend, horizon));
    close_from(count);
    turn_axes(nx, ny, gap, nx * dy - ny * dx - sized(one.turning + two.turning),
              sized(one.radius + two.radius));
  }

 private:
  VITREL_INLINE Many sized(const Many& x) const {
    if constexpr (grows) return common_.size * x;
    return x;
  }

  // The first root of room + rate s − ½ M s², or infinity if it lies beyond the horizon.
  VITREL_INLINE static Many first_root(const Many& room, const Many& rate, const Many& bend,
                                       const Many& horizon) {
    constexpr double nearly_straight = 1e-300;
    const Many acceleration = max(bend, Many(nearly_straight));
    const Many root = sqrt(rate * rate + 2. * acceleration * max(room, Many(0)));
    Many time = 2. * room / (root - rate);
    where(rate > 0, time) = (rate + root) / acceleration;
    const Many end = room + horizon * (rate - 0.5 * acceleration * horizon);
    where(end > 0, time) = Many(detail::no_contact);
    where(!(room > 0), time) = Many(0);
    return time;
  }

  // By Newton's method, as far as the axis can be trusted.
  VITREL_INLINE void turn_axes(const Many& nx, const Many& ny, const Many& gap, const Many& slope,
                               const Many& radii) {
    const Many turn = min(max(slope / (gap + radii), Many(-0.5)), Many(0.5));
    const Many q = 0.5 * turn;
    const Many scale = 1. / (1. + q * q);
    const Many cosine = (1. - q * q) * scale, sine = turn * scale;
    nx_.store(cosine * nx - sine * ny);
    ny_.store(cosine * ny + sine * nx);
  }

  using Numbers = detail::NumbersOf<many>;

  Outline<Shape> outline_;
  Motion2 motion_;
  CommonSize common_;
  double floor_;
  double ux_, uy_;
  Numbers dx_, dy_, vx_, vy_, angle_, omega_, bb_, stretch_, aabb_, bend_, nx_, ny_, horizon_;
};

template <>
class FirstLook<Disk> : public detail::Urgencies<8> {
 public:
  using Shape = Disk;
  static constexpr int lanes = 8;
  static constexpr bool is_exact = true;
  struct Memory {
    Memory() = default;
    explicit(false) Memory(const Vec2& /*axis*/) {}
  };

  FirstLook(const Outline<Disk>& outline, const Pose2& /*pose*/, const Motion2& motion,
            const CommonSize&, double contact_gap)
      : reach_(outline.radius + contact_gap), velocity_(motion.velocity) {}

  VITREL_INLINE void set(int k, const Pose2& pose, const Motion2& motion,
                         const Outline<Disk>& outline, const Memory&, double horizon) {
    dx_[k] = pose.position.x();
    dy_[k] = pose.position.y();
    vx_[k] = motion.velocity.x() - velocity_.x();
    vy_[k] = motion.velocity.y() - velocity_.y();
    radius_[k] = outline.radius;
    horizon_[k] = horizon;
  }
  Memory memory(int) const { return {}; }

  /// Finds the times of contact: infinite without, 0 for approaching pairs that touch or overlap.
  [[gnu::flatten]] void look(int count) {
    using Simd = detail::Simd<lanes>;
    const Simd dx = dx_.all(), dy = dy_.all(), vx = vx_.all(), vy = vy_.all();
    const Simd reach = radius_.all() + reach_;
    const Simd b = dx * vx + dy * vy;
    const Simd c = dx * dx + dy * dy - reach * reach;
    const Simd discriminant = b * b - (vx * vx + vy * vy) * c;
    Simd time = max(c / (sqrt(max(discriminant, Simd(0))) - b), Simd(0));
    where(!(b < 0) || !(discriminant >= 0) || !(time < horizon_.all()), time) =
        Simd(detail::no_contact);
    open_until_.store(time);
    close_from(count);
  }

 private:
  using Numbers = detail::NumbersOf<lanes>;

  double reach_;
  Vec2 velocity_;
  Numbers dx_, dy_, vx_, vy_, radius_, horizon_;
};

/// first_contact, beginning with what a look remembered.
inline Prediction first_contact(const Flight<Ellipse>& one, const Flight<Ellipse>& two,
                                double horizon, double contact_gap,
                                const FirstLook<Ellipse>::Memory& memory) {
  return first_contact(one, two, horizon, contact_gap, memory.axis);
}
inline Prediction first_contact(const Flight<GrowingEllipse>& one,
                                const Flight<GrowingEllipse>& two, double horizon,
                                double contact_gap,
                                const FirstLook<GrowingEllipse>::Memory& memory) {
  return first_contact(one, two, horizon, contact_gap, memory.axis);
}
inline Prediction first_contact(const Flight<Disk>& one, const Flight<Disk>& two, double horizon,
                                double contact_gap, const FirstLook<Disk>::Memory&) {
  return first_contact(one, two, horizon, contact_gap);
}

}  // namespace vitrel
