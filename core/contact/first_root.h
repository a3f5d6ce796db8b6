#pragma once

#include <cmath>
#include <limits>

#include "core/contact/simd_batch.h"

/// @file
/// First roots of quadratic functions of time, in forms without cancellation.
namespace vitrel::detail {

constexpr double no_contact = std::numeric_limits<double>::infinity();

/// Returns the first root of gap + rate s − ½ M s² for gap ≥ 0 and any M; infinity if there is none.
inline double first_root(double gap, double rate, double acceleration) {
  const double discriminant = rate * rate + 2 * acceleration * gap;
  if (!(discriminant >= 0)) return no_contact;
  const double root = std::sqrt(discriminant);
  if (rate < 0) return 2 * gap / (root - rate);
  return acceleration > 0 ? (rate + root) / acceleration : no_contact;
}

/// Returns the first roots of a batch, with M < 0 replaced by 0: infinity if the root lies beyond the horizon, 0 if the
/// gap is not positive. The scalar form makes use of M < 0, which lengthens its steps; in a batch, the branch would
/// cost more than it gains.
template <class T>
VITREL_INLINE T first_root(const T& gap, const T& rate, const T& acceleration_bound,
                           const T& horizon) {
  constexpr double min_acceleration = 1e-300;
  const T acceleration = max(acceleration_bound, T(min_acceleration));
  const T root = sqrt(rate * rate + 2. * acceleration * max(gap, T(0)));
  const auto opening = rate > T(0);
  const T time =
      select(opening, rate + root, 2. * gap) / select(opening, acceleration, root - rate);
  const T end = gap + horizon * (rate - 0.5 * acceleration * horizon);
  return select(gap > T(0), select(end > T(0), T(no_contact), time), T(0));
}

}  // namespace vitrel::detail
