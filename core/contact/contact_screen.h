#pragma once

#include <concepts>
#include <limits>

#include "core/contact/first_contact.h"
#include "core/contact/simd_batch.h"

/// One body and several partners at one instant: until when is contact surely impossible?
///
/// Most of the pairs that an event-driven run asks about do not touch before something else
/// happens. The first evaluate settles these, `simd_width` at a time, by one parabola each,
///     g(n, t + s) ≥ g + ġ s − ½ M s²   (first_contact.h),
/// along an axis n remembered from the last evaluate at the pair; every evaluate turns it by a step of
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
class CandidateTimes {
 public:
  struct Candidate {
    double time;
    int lane;
  };
  Candidate earliest() const {
    const double time = hmin(times_);
    return {time, find_first_set(times_ == time)};
  }
  /// Nothing more is to be known of this lane.
  void discard(int lane) { where(lane_indices<lanes> == lane, times_) = Simd<lanes>(no_contact); }

 protected:
  /// The times of the first `count` lanes.
  VITREL_INLINE void set_times(const Simd<lanes>& until, int count) {
    times_ = until;
    where(lane_indices<lanes> >= count, times_) = Simd<lanes>(no_contact);
  }

 private:
  Simd<lanes> times_;
};

/// The first root of gap + rate s − ½ M s², or infinity if it lies beyond the horizon.
VITREL_INLINE SimdBatch first_root(const SimdBatch& gap, const SimdBatch& rate,
                                   const SimdBatch& acceleration, const SimdBatch& horizon) {
  constexpr double nearly_straight = 1e-300;
  const SimdBatch acceleration = max(acceleration, SimdBatch(nearly_straight));
  const SimdBatch root = sqrt(rate * rate + 2. * acceleration * max(gap, SimdBatch(0)));
  SimdBatch time = 2. * gap / (root - rate);
  where(rate > 0, time) = (rate + root) / acceleration;
  const SimdBatch end = gap + horizon * (rate - 0.5 * acceleration * horizon);
  where(end > 0, time) = SimdBatch(no_contact);
  where(!(gap > 0), time) = SimdBatch(0);
  return time;
}

}  // namespace detail

/// A evaluate of a body at up to `lanes` partners. A body that grows is `BaseShape<B>` times the common size.
template <Body B>
class ContactScreen;

template <Body B>
requires std::same_as<BaseShape<B>, Ellipse>
class ContactScreen<B> : public detail::CandidateTimes<simd_width> {
  /// A gap that stays above this fraction of the contact gap stays set_times. It lets a pair that has
  /// just collided, and leaves, be settled too.
  static constexpr double min_gap_fraction = 0.5;

 public:
  static constexpr int lanes = simd_width;
  /// Whether open_until is the time of contact if it is not 0.
  static constexpr bool is_exact = false;
  /// What is remembered of a pair from one evaluate to the next.
  struct WarmStart {
    Vec2 axis;
    /// Of the same pair, seen from the other body.
    friend WarmStart reversed(const WarmStart& warm_start) { return {-warm_start.axis}; }
  };

  ContactScreen(const ShapeCoefficients<Ellipse>& coefficients, const Pose2& pose,
                const Motion2& motion, const CommonSize& common, double contact_gap)
      : coefficients_(coefficients),
        motion_(motion),
        common_(common),
        min_gap_(min_gap_fraction * contact_gap) {
    PairArray x, y;
    directions<PairArray>({pose.angle, pose.angle}, x, y);
    ux_ = x[0];
    uy_ = y[0];
  }

  /// Puts a partner into a lane: its pose, relative to this body's centre, and motion now, and how
  /// far to evaluate ahead.
  VITREL_INLINE void set(int k, const Pose2& pose, const Motion2& motion,
                         const ShapeCoefficients<Ellipse>& coefficients,
                         const WarmStart& warm_start, double horizon) {
    dx_[k] = pose.position.x();
    dy_[k] = pose.position.y();
    vx_[k] = motion.velocity.x() - motion_.velocity.x();
    vy_[k] = motion.velocity.y() - motion_.velocity.y();
    angle_[k] = pose.angle;
    omega_[k] = motion.angular_velocity;
    bb_[k] = coefficients.bb;
    aa_minus_bb_[k] = coefficients.aa_minus_bb;
    aabb_[k] = coefficients.aabb;
    max_second_derivative_[k] = coefficients.max_second_derivative;
    nx_[k] = warm_start.axis.x();
    ny_[k] = warm_start.axis.y();
    horizon_[k] = horizon;
  }
  WarmStart warm_start(int k) const { return {{nx_[k], ny_[k]}}; }

  /// Finds, for each of the first `count` lanes, a time before which there can be no contact:
  /// infinite if there is none up to the horizon, 0 if the axis separates nothing. Turns the axes.
  [[gnu::flatten]] void evaluate(int count) {
    const SimdBatch nx = nx_.load(), ny = ny_.load(), dx = dx_.load(), dy = dy_.load();
    const SimdBatch bb = bb_.load(), aa_minus_bb = aa_minus_bb_.load(), omega2 = omega_.load();
    const SimdBatch omega1 = motion_.angular_velocity, horizon = horizon_.load();
    SimdBatch ux, uy;
    directions<SimdBatch>(angle_.load(), ux, uy);
    const auto one = support_along<SimdBatch>(coefficients_.bb, coefficients_.aa_minus_bb,
                                              coefficients_.aabb, ux_, uy_, nx, ny);
    const auto two = support_along<SimdBatch>(bb, aa_minus_bb, aabb_.load(), ux, uy, nx, ny);
    const SimdBatch heights = one.height + two.height;
    const SimdBatch spin = omega1 * one.turning + omega2 * two.turning;
    const SimdBatch gap = nx * dx + ny * dy - sized(heights);
    SimdBatch rate = nx * vx_.load() + ny * vy_.load() + sized(spin);
    SimdBatch acceleration =
        support_acceleration_bound<SimdBatch>(
            one, coefficients_.bb, coefficients_.aa_minus_bb, omega1,
            omega1 * omega1 * coefficients_.max_second_derivative, horizon) +
        support_acceleration_bound<SimdBatch>(
            two, bb, aa_minus_bb, omega2, omega2 * omega2 * max_second_derivative_.load(), horizon);
    if constexpr (grows<B>) {
      const double growth = common_.growth_rate;
      rate -= growth * heights;
      acceleration = common_.size * acceleration + std::abs(growth) * horizon * abs(acceleration) -
                     2 * growth * spin;
    }
    set_times(detail::first_root(gap - min_gap_, rate, acceleration, horizon), count);
    SimdBatch turned_nx = nx, turned_ny = ny;
    detail::turn(turned_nx, turned_ny, nx * dy - ny * dx - sized(one.turning + two.turning),
                 gap + sized(one.radius + two.radius));
    nx_.store(turned_nx);
    ny_.store(turned_ny);
  }

 private:
  VITREL_INLINE SimdBatch sized(const SimdBatch& x) const {
    if constexpr (grows<B>) return common_.size * x;
    return x;
  }

  using Numbers = detail::BatchBuffer<simd_width>;

  ShapeCoefficients<Ellipse> coefficients_;
  Motion2 motion_;
  CommonSize common_;
  double min_gap_;
  double ux_, uy_;
  Numbers dx_, dy_, vx_, vy_, angle_, omega_, bb_, aa_minus_bb_, aabb_, max_second_derivative_, nx_,
      ny_, horizon_;
};

/// Disks and spheres: in closed form.
template <Body B>
requires std::same_as<BaseShape<B>, Disk> || std::same_as<BaseShape<B>, Sphere>
class ContactScreen<B> : public detail::CandidateTimes<8> {
  static constexpr int dimension = B::dimension;

 public:
  static constexpr int lanes = 8;
  static constexpr bool is_exact = true;
  struct WarmStart {
    WarmStart() = default;
    explicit(false) WarmStart(const Vec<dimension>& /*axis*/) {}
    friend WarmStart reversed(const WarmStart& warm_start) { return warm_start; }
  };

  ContactScreen(const ShapeCoefficients<BaseShape<B>>& coefficients,
                const Pose<dimension>& /*pose*/, const Motion<dimension>& motion,
                const CommonSize& common, double contact_gap)
      : radius_(coefficients.radius),
        velocity_(motion.velocity),
        common_(common),
        contact_gap_(contact_gap) {}

  VITREL_INLINE void set(int k, const Pose<dimension>& pose, const Motion<dimension>& motion,
                         const ShapeCoefficients<BaseShape<B>>& coefficients, const WarmStart&,
                         double horizon) {
    for (int x = 0; x < dimension; ++x) {
      d_[x][k] = pose.position[x];
      v_[x][k] = motion.velocity[x] - velocity_[x];
    }
    other_radius_[k] = coefficients.radius;
    horizon_[k] = horizon;
  }
  WarmStart warm_start(int) const { return {}; }

  /// Finds the times of contact: infinite without, 0 for approaching pairs that touch or overlap.
  [[gnu::flatten]] void evaluate(int count) {
    using Simd = detail::Simd<lanes>;
    const Simd radii = other_radius_.load() + radius_;
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
    where(misses || !(discriminant >= 0) || !(time < horizon_.load()), time) =
        Simd(detail::no_contact);
    set_times(time, count);
  }

 private:
  using Numbers = detail::BatchBuffer<lanes>;

  VITREL_INLINE static detail::Simd<lanes> product(const Numbers (&u)[dimension],
                                                   const Numbers (&v)[dimension]) {
    detail::Simd<lanes> sum = u[0].load() * v[0].load() + u[1].load() * v[1].load();
    if constexpr (dimension == 3) sum += u[2].load() * v[2].load();
    return sum;
  }

  double radius_;
  Vec<dimension> velocity_;
  CommonSize common_;
  double contact_gap_;
  Numbers d_[dimension], v_[dimension], other_radius_, horizon_;
};

/// first_contact, beginning with what a evaluate remembered.
template <Body B>
Prediction<B::dimension> first_contact(const Flight<B>& one, const Flight<B>& two, double horizon,
                                       double contact_gap,
                                       const typename ContactScreen<B>::WarmStart& warm_start) {
  if constexpr (ContactScreen<B>::is_exact)
    return first_contact(one, two, horizon, contact_gap);
  else
    return first_contact(one, two, horizon, contact_gap, warm_start.axis);
}

}  // namespace vitrel
