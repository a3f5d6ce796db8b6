#pragma once

#include "core/contact/first_contact.h"
#include "core/contact/first_root.h"
#include "core/contact/flight_record.h"
#include "core/contact/simd_batch.h"

/// @file
/// Lower bounds of the contact times of one body with several partners at one instant.
///
/// Most pairs whose contact an event-driven run predicts do not touch before another event happens to one of them. The
/// screen rules out their contact in SIMD batches, by one parabola per pair,
///
///     g(n, t + s) ≥ g + ġ s − ½ M s²   (first_contact.h),
///
/// along an axis n that is kept from one evaluation to the next; each evaluation turns it by one Newton step towards
/// the maximum of the gap. The screen of ellipses is in ellipse_contact_screen.h and that of ellipsoids in
/// ellipsoid_contact_screen.h. Disks and spheres need no bound, since their contact times are known in closed form
/// (round_contacts.h).
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
  /// Removes a lane that needs no further treatment.
  void discard(int lane) { times_ = select(lane_indices<lanes>() == lane, no_contact, times_); }

 protected:
  /// Sets the times of those of the first `count` lanes whose horizon has not passed; the other lanes have no contact.
  VITREL_INLINE void set_times(const Simd<lanes>& times, const Simd<lanes>& horizon, int count) {
    times_ = select(lane_indices<lanes>() < count && horizon >= 0, times, no_contact);
  }

 private:
  Simd<lanes> times_;
};

/// Returns the time from now to the earlier of `latest` and `known_until`, limited to a finite value.
template <class T>
VITREL_INLINE T horizon_of(const T& known_until, double latest, double now) {
  constexpr double forever = 1e100;
  return min(min(known_until, T(latest)) - now, T(forever));
}

/// The axis along which a pair was screened last.
template <int Dim>
struct ScreenAxis {
  Vec<Dim> axis;
  const double* numbers() const { return axis.data(); }
  /// Returns the axis as seen from the other body.
  friend ScreenAxis reversed(const ScreenAxis& known) { return {-known.axis}; }
};
template <int Dim>
struct NoAxis {
  NoAxis() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): round bodies ignore any axis they are given
  NoAxis(const Vec<Dim>&) {}
  friend NoAxis reversed(const NoAxis& none) { return none; }
};

}  // namespace detail

/// The data that a pair keeps from one prediction to the next.
template <Body B>
using WarmStart = std::conditional_t<RoundBody<B>, detail::NoAxis<B::dimension>,
                                     detail::ScreenAxis<B::dimension>>;

/// The screen of a body against `lanes` partners. A growing body is its `BaseShape<B>` times the common size.
///
///     (coefficients, mine, now, common size, contact gap)   partners have the coefficients of `mine`
///     set_shape(k, coefficients)   unless partner k has others
///     load(partners, warm starts, latest)   takes the partners, and screens each up to the earlier of `latest` and the
///                                  time up to which it knows its contacts; positions are relative to the box of `mine`
///     evaluate(count)   computes the times of the first `count` lanes from now: infinite if there is no contact, 0
///                       if the axis does not separate the pair
///     earliest, discard   give the lanes in the order of their times
///     warm_start(k)     returns what `load` needs next time
template <Body B>
class ContactScreen;

/// Calls first_contact with the time and the axis that the screen found.
template <Body B>
Prediction<B::dimension> first_contact(const Flight<B>& one, const Flight<B>& two, double horizon,
                                       double contact_gap, double screened_until,
                                       const WarmStart<B>& warm_start) {
  if constexpr (RoundBody<B>)
    return first_contact(one, two, horizon, contact_gap);
  else
    return first_contact(one, two, horizon, contact_gap, {screened_until, warm_start.axis});
}

}  // namespace vitrel
