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

/// One number of each of several pairs, filled one by one.
struct ManyInMemory {
  alignas(many * sizeof(double)) double lane[many] = {};
  double& operator[](int k) { return lane[k]; }
  double operator[](int k) const { return lane[k]; }
  Many all() const { return Many(lane, std::experimental::vector_aligned); }
  void store(const Many& x) { x.copy_to(lane, std::experimental::vector_aligned); }
};

constexpr double no_contact = std::numeric_limits<double>::infinity();

}  // namespace detail

/// A look of a body at up to `many` partners. The body of a `GrowingEllipse` is `Shape` times the common
/// size.
template <class B>
class FirstLook {
  static constexpr bool grows = std::is_same_v<B, GrowingEllipse>;

 public:
  using Shape = Ellipse;
  /// What is remembered of a pair from one look to the next.
  struct Memory {
    Vec2 axis;
  };

  FirstLook(const Outline<Shape>& outline, const Pose2& pose, const Motion2& motion,
            const CommonSize& common, double contact_gap)
      : outline_(outline), motion_(motion), common_(common), contact_gap_(contact_gap) {
    Lanes x, y;
    directions<Lanes>({pose.angle, pose.angle}, x, y);
    ux_ = x[0];
    uy_ = y[0];
  }

  /// Puts a partner into a lane: its pose, relative to this body's centre, and motion now, and how
  /// far to look ahead.
  void set(int k, const Pose2& pose, const Motion2& motion, const Outline<Shape>& outline,
           const Memory& memory, double horizon) {
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

  /// Finds, for every lane, a time before which the gap cannot fall below the contact gap: infinite
  /// if it cannot up to the horizon, 0 if the axis separates nothing.
  void look() {
    const Many nx = nx_.all(), ny = ny_.all(), dx = dx_.all(), dy = dy_.all(), vx = vx_.all(),
               vy = vy_.all(), omega2 = omega_.all(), horizon = horizon_.all();
    const Many omega1 = motion_.angular_velocity;
    Many ux, uy;
    directions<Many>(angle_.all(), ux, uy);
    const SupportAlong<Many> one = support_along<Many>(outline_.bb, outline_.stretch,
                                                       outline_.aabb, ux_, uy_, nx, ny);
    const SupportAlong<Many> two =
        support_along<Many>(bb_.all(), stretch_.all(), aabb_.all(), ux, uy, nx, ny);
    const Many heights = one.height + two.height;
    const Many gap = nx * dx + ny * dy - sized(heights);
    const Many spin = omega1 * one.turning + omega2 * two.turning;
    Many rate = nx * vx + ny * vy + sized(spin);
    Many bend = bend_bound<Many>(one, outline_.bb, outline_.stretch, omega1,
                                 omega1 * omega1 * outline_.bend, horizon) +
                bend_bound<Many>(two, bb_.all(), stretch_.all(), omega2,
                                 omega2 * omega2 * bend_.all(), horizon);
    if constexpr (grows) {
      const double growth = common_.growth_rate;
      rate -= growth * heights;
      bend = common_.size * bend + std::abs(growth) * horizon * abs(bend) - 2 * growth * spin;
    }
    open_until_.store(first_root(gap - contact_gap_, rate, bend, horizon));
    turn_axes(nx, ny, gap, nx * dy - ny * dx - sized(one.turning + two.turning),
              sized(one.radius + two.radius));
  }

  double open_until(int k) const { return open_until_[k]; }
  /// Nothing more is to be known of this lane.
  void close(int k) { open_until_[k] = detail::no_contact; }
  Memory memory(int k) const { return {{nx_[k], ny_[k]}}; }

 private:
  Many sized(const Many& x) const {
    if constexpr (grows) return common_.size * x;
    return x;
  }

  // The first root of room + rate s − ½ M s², or infinity if it lies beyond the horizon.
  static Many first_root(const Many& room, const Many& rate, const Many& bend,
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

  void turn_axes(const Many& nx, const Many& ny, const Many& gap, const Many& slope,
                 const Many& radii) {
    const Many curvature = gap + radii;
    Many turn = slope / curvature;
    turn = min(max(turn, Many(-0.5)), Many(0.5));
    const Many q = 0.5 * turn;
    const Many scale = 1. / (1. + q * q);
    const Many cosine = (1. - q * q) * scale, sine = turn * scale;
    nx_.store(cosine * nx - sine * ny);
    ny_.store(cosine * ny + sine * nx);
  }

  Outline<Shape> outline_;
  Motion2 motion_;
  CommonSize common_;
  double contact_gap_;
  double ux_, uy_;
  detail::ManyInMemory dx_, dy_, vx_, vy_, angle_, omega_, bb_, stretch_, aabb_, bend_, nx_, ny_,
      horizon_, open_until_;
};

template <>
class FirstLook<Disk> {
 public:
  using Shape = Disk;
  struct Memory {
    Memory() = default;
    explicit(false) Memory(const Vec2& /*axis*/) {}
  };

  FirstLook(const Outline<Disk>& outline, const Pose2& pose, const Motion2& motion,
            const CommonSize&, double contact_gap)
      : reach_(outline.radius + contact_gap), velocity_(motion.velocity) {}

  void set(int k, const Pose2& pose, const Motion2& motion, const Outline<Disk>& outline,
           const Memory&, double /*horizon*/) {
    dx_[k] = pose.position.x();
    dy_[k] = pose.position.y();
    vx_[k] = motion.velocity.x() - velocity_.x();
    vy_[k] = motion.velocity.y() - velocity_.y();
    radius_[k] = outline.radius;
  }

  /// Times of contact in all lanes, infinite without; 0 for overlaps that close.
  void look() {
    const Many dx = dx_.all(), dy = dy_.all(), vx = vx_.all(), vy = vy_.all();
    const Many reach = radius_.all() + reach_;
    const Many b = dx * vx + dy * vy;
    const Many c = dx * dx + dy * dy - reach * reach;
    const Many discriminant = b * b - (vx * vx + vy * vy) * c;
    Many time = c / (sqrt(max(discriminant, Many(0))) - b);
    where(!(b < 0) || !(discriminant >= 0), time) = Many(detail::no_contact);
    open_until_.store(max(time, Many(0)));
  }
  double open_until(int k) const { return open_until_[k]; }
  /// Nothing more is to be known of this lane.
  void close(int k) { open_until_[k] = detail::no_contact; }
  Memory memory(int) const { return {}; }

 private:
  double reach_;
  Vec2 velocity_;
  detail::ManyInMemory dx_, dy_, vx_, vy_, radius_, open_until_;
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
