#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/simd_batch.h"

/// @file
/// First roots of quadratic functions of time, in forms without cancellation.
namespace vitrel::detail {

constexpr double no_contact = std::numeric_limits<double>::infinity();

/// The first t ≥ 0 with |d + v t| = r + γ t, for circles or spheres. With a = v² − γ², b = d·v − r γ and
/// c = d² − r² it is a root of a t² + 2 b t + c; root = √(b² − a c).
/// b < 0: the surfaces approach; 0 if they already touch (c ≤ 0).
///
/// What precedes these formulas is written out where they are used: first_contact.cpp computes c as
/// (|d| − r)(|d| + r), which is more accurate near contact; contact_screen.h saves the square root of d².
template <class T>
VITREL_INLINE T closing_time(const T& b, const T& c, const T& root) {
  using std::max;
  return max(c / (root - b), T(0));
}
/// b ≥ 0 and a < 0: the centres recede, but the radii grow faster.
template <class T>
VITREL_INLINE T overtaking_time(const T& a, const T& b, const T& root) {
  return (b + root) / -a;
}

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
