#pragma once

#include <concepts>
#include <limits>

#include "core/contact/first_contact.h"
#include "core/contact/first_root.h"
#include "core/contact/simd_batch.h"

/// @file
/// Lower bounds of the contact times of one body with several partners at one instant.
///
/// Most pairs that an event-driven run asks about do not touch before another event happens to one of
/// them. The screen settles these in SIMD batches, by one parabola per pair,
///
///     g(n, t + s) ≥ g + ġ s − ½ M s²   (first_contact.h),
///
/// along an axis n that is kept from one evaluation to the next; each evaluation turns it by one Newton
/// step towards the maximum of the gap. Disks and spheres need no axis: their contact time is known in
/// closed form. Ellipses: ellipse_contact_screen.h; ellipsoids: ellipsoid_contact_screen.h.
namespace vitrel {

/// The size that all bodies share, and its growth rate.
struct CommonSize {
  double size = 1;
  double growth_rate = 0;
};

namespace detail {

/// The candidate time of each lane, and the earliest of them.
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
  /// Removes a lane that has been dealt with.
  void discard(int lane) { times_ = select(lane_indices<lanes>() == lane, no_contact, times_); }

 protected:
  /// Sets the first `count` lanes; the others have no contact.
  VITREL_INLINE void set_times(const Simd<lanes>& times, int count) {
    times_ = select(lane_indices<lanes>() < count, times, no_contact);
  }

 private:
  Simd<lanes> times_;
};

}  // namespace detail

/// The screen of a body against up to `lanes` partners. A growing body is its `BaseShape<B>` times the
/// common size.
///
///     set(k, pose, motion, coefficients, warm_start, horizon)  fills lane k: pose relative to the centre of
///                       the body, current motion, and time up to which to screen
///     evaluate(count)   computes the times of the first `count` lanes: infinite if there is no contact up to
///                       the horizon, 0 if the axis does not separate the pair
///     earliest, discard the lanes in the order of their times
///     warm_start(k)     what to pass to `set` next time
///     is_exact          whether a time other than 0 is the contact time itself
template <Body B>
class ContactScreen;

/// Disks and spheres, in closed form: infinite without a contact, 0 for approaching pairs that touch or
/// overlap.
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

  [[gnu::flatten]] void evaluate(int count) {
    using Batch = Simd<lanes>;
    const Batch radii = other_radius_.load() + radius_;
    Batch reach = radii + contact_gap_;
    if constexpr (grows<B>) reach = common_.size * radii + contact_gap_;
    const Batch c = product(d_, d_) - reach * reach;
    Batch b = product(d_, v_), a = product(v_, v_);
    if constexpr (grows<B>) {
      const Batch growth = common_.growth_rate * radii;
      b -= reach * growth;
      a -= growth * growth;
    }
    const Batch discriminant = b * b - a * c;
    const Batch root = sqrt(max(discriminant, Batch(0)));
    Batch time = detail::closing_time(b, c, root);
    auto misses = !(b < 0);
    if constexpr (grows<B>) {
      // The centres recede, but the surfaces grow faster.
      time = select(misses && a < 0, max(detail::overtaking_time(a, b, root), Batch(0)), time);
      misses = misses && !(a < 0);
    }
    const auto hits = !misses && discriminant >= 0 && time < horizon_.load();
    set_times(select(hits, time, detail::no_contact), count);
  }

 private:
  using Numbers = detail::BatchBuffer<lanes>;

  VITREL_INLINE static Simd<lanes> product(const Numbers (&u)[dimension],
                                           const Numbers (&v)[dimension]) {
    Simd<lanes> sum = u[0].load() * v[0].load() + u[1].load() * v[1].load();
    if constexpr (dimension == 3) sum += u[2].load() * v[2].load();
    return sum;
  }

  double radius_;
  Vec<dimension> velocity_;
  CommonSize common_;
  double contact_gap_;
  Numbers d_[dimension], v_[dimension], other_radius_, horizon_;
};

/// first_contact, starting from the axis that the screen found.
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
