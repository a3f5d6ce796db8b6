#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

/// @file
/// Arithmetic on the two bodies of a pair at once, and on a SIMD batch of pairs. Formulas are templates over the
/// two types.
///
/// The number of lanes is fixed, and every lane is rounded as a number alone would be: results do not depend on the
/// instruction set. std::experimental::simd does the same, but takes several times as long to compile, and not every
/// compiler has it.
namespace vitrel {

/// For short functions, whose vector arguments would otherwise pass through memory, and for functions that call many of
/// them. With sanitizers their code would be too large.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define VITREL_INLINE inline
#define VITREL_FLATTEN
#else
#define VITREL_INLINE [[gnu::always_inline]] inline
#define VITREL_FLATTEN [[gnu::flatten]]
#endif

/// One number for each of the two bodies of a pair.
using PairArray = Eigen::Array2d;

namespace detail {

#ifdef __AVX__
constexpr int register_lanes = 4;
#else
constexpr int register_lanes = 2;
#endif
using Register [[gnu::vector_size(register_lanes * sizeof(double))]] = double;
using MaskRegister = decltype(Register{} < Register{});  // every lane 0 or −1

VITREL_INLINE Register square_root(const Register& x) {
#if defined(__AVX__)
  return _mm256_sqrt_pd(x);
#elif defined(__SSE2__)
  return _mm_sqrt_pd(x);
#else
  Register root;
  for (int k = 0; k < register_lanes; ++k) root[k] = std::sqrt(x[k]);
  return root;
#endif
}

/// Bit k is lane k.
VITREL_INLINE unsigned bits(const MaskRegister& mask) {
#if defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_pd(std::bit_cast<__m256d>(mask)));
#elif defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd(std::bit_cast<__m128d>(mask)));
#else
  unsigned all = 0;
  for (int k = 0; k < register_lanes; ++k) all |= static_cast<unsigned>(mask[k] & 1) << k;
  return all;
#endif
}

/// Four numbers in single precision.
using FloatRegister [[gnu::vector_size(16)]] = float;
using FloatMaskRegister = decltype(FloatRegister{} < FloatRegister{});

VITREL_INLINE unsigned bits(const FloatMaskRegister& mask) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(std::bit_cast<__m128>(mask)));
#else
  unsigned all = 0;
  for (int k = 0; k < 4; ++k) all |= static_cast<unsigned>(mask[k] & 1) << k;
  return all;
#endif
}

}  // namespace detail

/// One truth value for each of several pairs. Both sides of && and || are evaluated.
template <int lanes>
struct alignas(lanes * sizeof(double)) SimdMask {
  static constexpr int parts = lanes / detail::register_lanes;
  detail::MaskRegister part[parts];

  SimdMask() = default;
  explicit SimdMask(bool value) {
    for (auto& one : part) one = detail::MaskRegister{} - static_cast<int>(value);
  }

  bool operator[](int k) const {
    return part[k / detail::register_lanes][k % detail::register_lanes] != 0;
  }

  VITREL_INLINE friend SimdMask operator!(const SimdMask& x) {
    SimdMask result;
    for (int p = 0; p < parts; ++p) result.part[p] = ~x.part[p];
    return result;
  }
  VITREL_INLINE friend SimdMask operator&&(const SimdMask& x, const SimdMask& y) {
    SimdMask result;
    for (int p = 0; p < parts; ++p) result.part[p] = x.part[p] & y.part[p];
    return result;
  }
  VITREL_INLINE friend SimdMask operator||(const SimdMask& x, const SimdMask& y) {
    SimdMask result;
    for (int p = 0; p < parts; ++p) result.part[p] = x.part[p] | y.part[p];
    return result;
  }

  /// Bit k is lane k.
  VITREL_INLINE unsigned bits() const {
    unsigned all = 0;
    for (int p = 0; p < parts; ++p) all |= detail::bits(part[p]) << (p * detail::register_lanes);
    return all;
  }
  VITREL_INLINE friend bool any_of(const SimdMask& x) { return x.bits() != 0; }
  VITREL_INLINE friend bool none_of(const SimdMask& x) { return x.bits() == 0; }
  VITREL_INLINE friend bool all_of(const SimdMask& x) { return x.bits() == (1u << lanes) - 1; }
  /// The first true lane; there must be one.
  VITREL_INLINE friend int find_first_set(const SimdMask& x) { return std::countr_zero(x.bits()); }
};

/// One number for each of several pairs.
template <int lanes>
struct alignas(lanes * sizeof(double)) Simd {
  static constexpr int parts = lanes / detail::register_lanes;
  using Mask = SimdMask<lanes>;
  detail::Register part[parts];

  Simd() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number stands for equal numbers in all lanes
  VITREL_INLINE Simd(double value) {
    for (auto& one : part) one = value - detail::Register{};
  }
  /// From and to `lanes` numbers in a row.
  VITREL_INLINE static Simd load(const double* from) {
    Simd result;
    for (int p = 0; p < parts; ++p, from += detail::register_lanes)
      std::memcpy(&result.part[p], from, sizeof(detail::Register));
    return result;
  }
  VITREL_INLINE void store(double* to) const {
    for (int p = 0; p < parts; ++p, to += detail::register_lanes)
      std::memcpy(to, &part[p], sizeof(detail::Register));
  }

  VITREL_INLINE double operator[](int k) const {
    return part[k / detail::register_lanes][k % detail::register_lanes];
  }
  VITREL_INLINE void set(int k, double value) {
    part[k / detail::register_lanes][k % detail::register_lanes] = value;
  }

  VITREL_INLINE friend Simd operator-(const Simd& x) {
    Simd result;
    for (int p = 0; p < parts; ++p) result.part[p] = -x.part[p];
    return result;
  }
  VITREL_INLINE friend Simd operator+(const Simd& x, const Simd& y) {
    Simd result;
    for (int p = 0; p < parts; ++p) result.part[p] = x.part[p] + y.part[p];
    return result;
  }
  VITREL_INLINE friend Simd operator-(const Simd& x, const Simd& y) {
    Simd result;
    for (int p = 0; p < parts; ++p) result.part[p] = x.part[p] - y.part[p];
    return result;
  }
  VITREL_INLINE friend Simd operator*(const Simd& x, const Simd& y) {
    Simd result;
    for (int p = 0; p < parts; ++p) result.part[p] = x.part[p] * y.part[p];
    return result;
  }
  VITREL_INLINE friend Simd operator/(const Simd& x, const Simd& y) {
    Simd result;
    for (int p = 0; p < parts; ++p) result.part[p] = x.part[p] / y.part[p];
    return result;
  }
  VITREL_INLINE Simd& operator+=(const Simd& x) { return *this = *this + x; }
  VITREL_INLINE Simd& operator-=(const Simd& x) { return *this = *this - x; }
  VITREL_INLINE Simd& operator*=(const Simd& x) { return *this = *this * x; }

  VITREL_INLINE friend Mask operator<(const Simd& x, const Simd& y) {
    Mask result;
    for (int p = 0; p < parts; ++p) result.part[p] = x.part[p] < y.part[p];
    return result;
  }
  VITREL_INLINE friend Mask operator<=(const Simd& x, const Simd& y) {
    Mask result;
    for (int p = 0; p < parts; ++p) result.part[p] = x.part[p] <= y.part[p];
    return result;
  }
  VITREL_INLINE friend Mask operator==(const Simd& x, const Simd& y) {
    Mask result;
    for (int p = 0; p < parts; ++p) result.part[p] = x.part[p] == y.part[p];
    return result;
  }
  VITREL_INLINE friend Mask operator>(const Simd& x, const Simd& y) { return y < x; }
  VITREL_INLINE friend Mask operator>=(const Simd& x, const Simd& y) { return y <= x; }

  /// x where the mask is true, y elsewhere.
  VITREL_INLINE friend Simd select(const Mask& mask, const Simd& x, const Simd& y) {
    Simd result;
    for (int p = 0; p < parts; ++p) result.part[p] = mask.part[p] ? x.part[p] : y.part[p];
    return result;
  }
  /// y if either is not a number.
  VITREL_INLINE friend Simd min(const Simd& x, const Simd& y) {
    Simd result;
    for (int p = 0; p < parts; ++p) result.part[p] = x.part[p] < y.part[p] ? x.part[p] : y.part[p];
    return result;
  }
  VITREL_INLINE friend Simd max(const Simd& x, const Simd& y) {
    Simd result;
    for (int p = 0; p < parts; ++p) result.part[p] = x.part[p] > y.part[p] ? x.part[p] : y.part[p];
    return result;
  }
  VITREL_INLINE friend Simd sqrt(const Simd& x) {
    Simd result;
    for (int p = 0; p < parts; ++p) result.part[p] = detail::square_root(x.part[p]);
    return result;
  }
  VITREL_INLINE friend Simd abs(const Simd& x) { return copysign(x, Simd(0)); }
  /// |x| with the sign of y.
  VITREL_INLINE friend Simd copysign(const Simd& x, const Simd& y) {
    const auto sign = std::bit_cast<detail::MaskRegister>(-detail::Register{});  // of −0.0
    Simd result;
    for (int p = 0; p < parts; ++p)
      result.part[p] =
          std::bit_cast<detail::Register>((std::bit_cast<detail::MaskRegister>(x.part[p]) & ~sign) |
                                          (std::bit_cast<detail::MaskRegister>(y.part[p]) & sign));
    return result;
  }
  /// The smallest lane.
  VITREL_INLINE friend double hmin(const Simd& x) {
    detail::Register least = x.part[0];
    for (int p = 1; p < parts; ++p) least = least < x.part[p] ? least : x.part[p];
    double result = least[0];
    for (int k = 1; k < detail::register_lanes; ++k) result = std::min(result, least[k]);
    return result;
  }
};

constexpr int simd_width = 4;
using SimdBatch = Simd<simd_width>;

namespace detail {

/// ±1, the sign bit of each lane.
VITREL_INLINE PairArray signs(const PairArray& x) {
  return {std::copysign(1.0, x[0]), std::copysign(1.0, x[1])};
}
template <int lanes>
VITREL_INLINE Simd<lanes> signs(const Simd<lanes>& x) {
  return copysign(Simd<lanes>(1), x);
}
inline double signs(double x) {
  return std::copysign(1.0, x);
}

VITREL_INLINE PairArray minimum(const PairArray& x, const PairArray& y) {
  return x.min(y);
}
template <int lanes>
VITREL_INLINE Simd<lanes> minimum(const Simd<lanes>& x, const Simd<lanes>& y) {
  return min(x, y);
}

VITREL_INLINE PairArray positive_part(const PairArray& x) {
  return x.max(0);
}
template <int lanes>
VITREL_INLINE Simd<lanes> positive_part(const Simd<lanes>& x) {
  return max(x, Simd<lanes>(0));
}

VITREL_INLINE bool all_below(const PairArray& x, double limit) {
  return x.maxCoeff() < limit;
}
template <int lanes>
VITREL_INLINE bool all_below(const Simd<lanes>& x, double limit) {
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
[[gnu::noinline]] inline void library_directions(const PairArray& angle, PairArray& x,
                                                 PairArray& y) {
  x = {std::cos(angle[0]), std::cos(angle[1])};
  y = {std::sin(angle[0]), std::sin(angle[1])};
}
template <int lanes>
[[gnu::noinline]] void library_directions(const Simd<lanes>& angle, Simd<lanes>& x,
                                          Simd<lanes>& y) {
  double cosine[lanes], sine[lanes];
  for (int k = 0; k < lanes; ++k) {
    cosine[k] = std::cos(angle[k]);
    sine[k] = std::sin(angle[k]);
  }
  x = Simd<lanes>::load(cosine);
  y = Simd<lanes>::load(sine);
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
