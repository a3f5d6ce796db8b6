#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/simd_batch.h"

/// @file
/// First roots of quadratic functions of time, in forms without cancellation.
namespace vitrel::detail {

constexpr double no_contact = std::numeric_limits<double>::infinity();

/// The first root of gap + rate s − ½ M s² for gap ≥ 0 and any M; infinity if there is none.
inline double first_root(double gap, double rate, double acceleration) {
  const double discriminant = rate * rate + 2 * acceleration * gap;
  if (!(discriminant >= 0)) return no_contact;
  const double root = std::sqrt(discriminant);
  if (rate < 0) return 2 * gap / (root - rate);
  return acceleration > 0 ? (rate + root) / acceleration : no_contact;
}

/// The same in a batch, with M < 0 replaced by 0: infinity if the root lies beyond the horizon, 0 if the gap
/// is not positive. The scalar form makes use of M < 0, which lengthens its steps; here the branch would
/// cost more than it gains.
VITREL_INLINE SimdBatch first_root(const SimdBatch& gap, const SimdBatch& rate,
                                   const SimdBatch& acceleration_bound, const SimdBatch& horizon) {
  constexpr double min_acceleration = 1e-300;
  const SimdBatch acceleration = max(acceleration_bound, SimdBatch(min_acceleration));
  const SimdBatch root = sqrt(rate * rate + 2. * acceleration * max(gap, SimdBatch(0)));
  const SimdBatch time = select(rate > 0, (rate + root) / acceleration, 2. * gap / (root - rate));
  const SimdBatch end = gap + horizon * (rate - 0.5 * acceleration * horizon);
  return select(gap > 0, select(end > 0, no_contact, time), 0);
}

}  // namespace vitrel::detail
