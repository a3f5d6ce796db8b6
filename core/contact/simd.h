#pragma once

#include <Eigen/Core>
#include <cmath>
#include <experimental/simd>

/// @file
/// Arithmetic on the two bodies of a pair at once, and on a SIMD batch of pairs. Formulas are templates over the
/// two types.
namespace vitrel {

/// For short functions, whose vector arguments would otherwise pass through memory. With sanitizers their code would be
/// too large.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define VITREL_INLINE inline
#else
#define VITREL_INLINE [[gnu::always_inline]] inline
#endif

/// One number for each of the two bodies of a pair.
using PairArray = Eigen::Array2d;

/// One number for each of `simd_width` pairs.
constexpr int simd_width = 4;
using SimdBatch = std::experimental::fixed_size_simd<double, simd_width>;

namespace detail {

/// ±1, the sign bit of each lane.
VITREL_INLINE PairArray signs(const PairArray& x) {
  return {std::copysign(1.0, x[0]), std::copysign(1.0, x[1])};
}
VITREL_INLINE SimdBatch signs(const SimdBatch& x) {
  return copysign(SimdBatch(1), x);
}

inline double signs(double x) {
  return std::copysign(1.0, x);
}

VITREL_INLINE PairArray minimum(const PairArray& x, const PairArray& y) {
  return x.min(y);
}
VITREL_INLINE SimdBatch minimum(const SimdBatch& x, const SimdBatch& y) {
  return min(x, y);
}

VITREL_INLINE PairArray positive_part(const PairArray& x) {
  return x.max(0);
}
VITREL_INLINE SimdBatch positive_part(const SimdBatch& x) {
  return max(x, SimdBatch(0));
}

VITREL_INLINE bool all_below(const PairArray& x, double limit) {
  return x.maxCoeff() < limit;
}
VITREL_INLINE bool all_below(const SimdBatch& x, double limit) {
  return all_of(x < limit);
}

// Taylor series of sine and cosine for |x| ≤ π/2, to 2e-17, split into independent parts (Estrin's scheme).
// xx = x².
template <class T>
VITREL_INLINE T sine_series(const T& x, const T& xx) {
  const T x4 = xx * xx;
  const T part1 = 1. / 120 * xx - 1. / 6;
  const T part2 = 1. / 362880 * xx - 1. / 5040;
  const T part3 = 1. / 6227020800 * xx - 1. / 39916800;
  const T part4 = 1. / 355687428096000 * xx - 1. / 1307674368000;
  const T part5 = 1. / 51090942171709440000. * xx - 1. / 121645100408832000;
  const T x8 = x4 * x4;
  return x + x * xx * ((part1 + x4 * part2) + x8 * ((part3 + x4 * part4) + x8 * part5));
}

template <class T>
VITREL_INLINE T cosine_series(const T& xx) {
  const T x4 = xx * xx;
  const T part1 = 1. / 24 - 1. / 720 * xx;
  const T part2 = 1. / 40320 - 1. / 3628800 * xx;
  const T part3 = 1. / 479001600 - 1. / 87178291200 * xx;
  const T part4 = 1. / 20922789888000 - 1. / 6402373705728000 * xx;
  const T x8 = x4 * x4;
  const T part5 = x8 * (1. / 2432902008176640000);
  return (1 - 0.5 * xx) + x4 * ((part1 + x4 * part2) + x8 * ((part3 + x4 * part4) + part5));
}

/// As `directions`, by the standard library: for angles so large that subtracting multiples of π is no longer
/// exact.
constexpr double max_reducible_angle = 1e6;
template <class T>
[[gnu::noinline]] void library_directions(const T& angle, T& x, T& y) {
  for (int k = 0; k < static_cast<int>(angle.size()); ++k) {
    x[k] = std::cos(static_cast<double>(angle[k]));
    y[k] = std::sin(static_cast<double>(angle[k]));
  }
}

}  // namespace detail

/// Unit vectors (x, y) at the angles: cosine and sine to within 4 units in the last place of 1.
template <class T>
VITREL_INLINE void directions(const T& angle, T& x, T& y) {
  if (!detail::all_below(abs(angle), detail::max_reducible_angle))
    return detail::library_directions(angle, x, y);
  // Adding and subtracting this number rounds to an integer. π is subtracted in three parts, so that multiples
  // of the first are exact.
  constexpr double rounder = 0x1.8p52;
  constexpr double pi_high = 0x1.921fb544p1;
  constexpr double pi_middle = 0x1.0b4611a6p-33;
  constexpr double pi_low = 0x1.3198a2e037073p-68;
  const T k = (angle * 0.31830988618379067154 + rounder) - rounder;
  const T rest = ((angle - k * pi_high) - k * pi_middle) - k * pi_low;
  const T half = (0.5 * k + rounder) - rounder;
  const T odd = k - 2 * half;
  const T sign = 1 - 2 * abs(odd);
  const T square = rest * rest;
  x = sign * detail::cosine_series<T>(square);
  y = sign * detail::sine_series<T>(rest, square);
}

constexpr double max_small_angle = 1.5;

/// As `directions`, for |angle| ≤ max_small_angle.
template <class T>
VITREL_INLINE void small_angle_directions(const T& angle, T& x, T& y) {
  const T square = angle * angle;
  x = detail::cosine_series<T>(square);
  y = detail::sine_series<T>(angle, square);
}

}  // namespace vitrel
