#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "core/elementary.h"

/// @file
/// SIMD arithmetic on the two bodies of a pair at once, and on a batch of pairs. Formulas are templates over the number
/// of lanes.
///
/// The number of lanes is fixed, and every lane is rounded as a single number would be, so results do not depend on the
/// instruction set. std::experimental::simd does the same, but takes several times as long to compile, and not every
/// compiler has it.
namespace vitrel {

/// VITREL_INLINE is for short functions, whose vector arguments would otherwise pass through memory, and VITREL_FLATTEN
/// for functions that call many of them. With sanitizers neither inlines, because the code would be too large.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define VITREL_INLINE inline
#define VITREL_FLATTEN
#else
#define VITREL_INLINE [[gnu::always_inline]] inline
#define VITREL_FLATTEN [[gnu::flatten]]
#endif

namespace detail {

#ifdef __AVX__
constexpr int widest_register = 4;
#else
constexpr int widest_register = 2;
#endif
template <int width>
using Register [[gnu::vector_size(width * sizeof(double))]] = double;
template <int width>
using MaskRegister = decltype(Register<width>{} < Register<width>{});  // every lane is 0 or −1

VITREL_INLINE Register<2> square_root(const Register<2>& x) {
#if defined(__SSE2__)
  return _mm_sqrt_pd(x);
#else
  return Register<2>{std::sqrt(x[0]), std::sqrt(x[1])};
#endif
}
#if defined(__AVX__)
VITREL_INLINE Register<4> square_root(const Register<4>& x) {
  return _mm256_sqrt_pd(x);
}
#endif

/// Bit k is lane k.
#if defined(__AVX__)
VITREL_INLINE unsigned bits(const MaskRegister<4>& mask) {
  return static_cast<unsigned>(_mm256_movemask_pd(std::bit_cast<__m256d>(mask)));
}
#endif
VITREL_INLINE unsigned bits(const MaskRegister<2>& mask) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd(std::bit_cast<__m128d>(mask)));
#else
  return static_cast<unsigned>(mask[0] & 1) | static_cast<unsigned>(mask[1] & 1) << 1;
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

/// One truth value for each of several pairs. && and || evaluate both operands.
template <int lanes>
struct alignas(lanes * sizeof(double)) SimdMask {
  static constexpr int width = std::min(lanes, detail::widest_register);  // lanes per register
  static constexpr int parts = lanes / width;
  using Register = detail::MaskRegister<width>;
  Register part[parts];

  SimdMask() = default;
  explicit SimdMask(bool value) {
    for (auto& one : part) one = Register{} - static_cast<int>(value);
  }

  bool operator[](int k) const { return part[k / width][k % width] != 0; }

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
    for (int p = 0; p < parts; ++p) all |= detail::bits(part[p]) << (p * width);
    return all;
  }
  VITREL_INLINE friend bool any_of(const SimdMask& x) { return x.bits() != 0; }
  VITREL_INLINE friend bool none_of(const SimdMask& x) { return x.bits() == 0; }
  VITREL_INLINE friend bool all_of(const SimdMask& x) { return x.bits() == (1u << lanes) - 1; }
  /// Returns the first true lane; there must be one.
  VITREL_INLINE friend int find_first_set(const SimdMask& x) { return std::countr_zero(x.bits()); }
};

/// One number for each of several pairs, or for each body of a pair.
template <int lanes>
struct alignas(lanes * sizeof(double)) Simd {
  using Mask = SimdMask<lanes>;
  static constexpr int width = Mask::width;
  static constexpr int parts = Mask::parts;
  using Register = detail::Register<width>;
  Register part[parts];

  Simd() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number stands for equal numbers in all lanes
  VITREL_INLINE Simd(double value) {
    for (auto& one : part) one = value - Register{};
  }
  /// Sets the two numbers of a pair.
  VITREL_INLINE Simd(double first, double second) : part{{first, second}} {
    static_assert(lanes == 2);
  }
  /// load and store read and write `lanes` contiguous numbers.
  VITREL_INLINE static Simd load(const double* from) {
    Simd result;
    for (int p = 0; p < parts; ++p, from += width)
      std::memcpy(&result.part[p], from, sizeof(Register));
    return result;
  }
  VITREL_INLINE void store(double* to) const {
    for (int p = 0; p < parts; ++p, to += width) std::memcpy(to, &part[p], sizeof(Register));
  }

  VITREL_INLINE double operator[](int k) const { return part[k / width][k % width]; }
  VITREL_INLINE void set(int k, double value) { part[k / width][k % width] = value; }

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

  /// Returns x where the mask is true, and y elsewhere.
  VITREL_INLINE friend Simd select(const Mask& mask, const Simd& x, const Simd& y) {
    Simd result;
    for (int p = 0; p < parts; ++p) result.part[p] = mask.part[p] ? x.part[p] : y.part[p];
    return result;
  }
  /// min and max return y if x or y is not a number.
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
  /// Returns |x| with the sign of y.
  VITREL_INLINE friend Simd copysign(const Simd& x, const Simd& y) {
    using Bits = typename Mask::Register;
    const auto sign = std::bit_cast<Bits>(-Register{});  // the bits of −0.0
    Simd result;
    for (int p = 0; p < parts; ++p)
      result.part[p] = std::bit_cast<Register>((std::bit_cast<Bits>(x.part[p]) & ~sign) |
                                               (std::bit_cast<Bits>(y.part[p]) & sign));
    return result;
  }
  /// The smallest lane.
  VITREL_INLINE friend double hmin(const Simd& x) {
    Register least = x.part[0];
    for (int p = 1; p < parts; ++p) least = least < x.part[p] ? least : x.part[p];
    double result = least[0];
    for (int k = 1; k < width; ++k) result = std::min(result, least[k]);
    return result;
  }
  /// The sum of the lanes.
  VITREL_INLINE friend double reduce(const Simd& x) {
    double sum = x[0];
    for (int k = 1; k < lanes; ++k) sum += x[k];
    return sum;
  }
};

constexpr int simd_width = 4;
using SimdBatch = Simd<simd_width>;
/// One number for each of the two bodies of a pair.
using SimdPair = Simd<2>;

namespace detail {

/// Returns +1 or −1 in each lane, with the sign bit of x.
template <int lanes>
VITREL_INLINE Simd<lanes> signs(const Simd<lanes>& x) {
  return copysign(Simd<lanes>(1), x);
}
inline double signs(double x) {
  return std::copysign(1.0, x);
}

template <class T>
VITREL_INLINE T positive_part(const T& x) {
  return max(x, T(0));
}

/// Computes `directions` lane by lane, for angles of any size.
template <int lanes>
[[gnu::noinline]] void single_directions(const Simd<lanes>& angle, Simd<lanes>& x, Simd<lanes>& y) {
  for (int k = 0; k < lanes; ++k) {
    const CosineAndSine one = cosine_and_sine(angle[k]);
    x.set(k, one.cosine);
    y.set(k, one.sine);
  }
}

}  // namespace detail

/// Computes unit vectors (x, y) at the angles: cosine and sine to within 4 units in the last place of 1.
template <class T>
VITREL_INLINE void directions(const T& angle, T& x, T& y) {
  if (!all_of(abs(angle) < detail::max_reducible_angle))
    return detail::single_directions(angle, x, y);
  detail::reduced_cosine_and_sine<T>(angle, x, y);
}

constexpr double max_small_angle = 1.5;

/// Computes unit vectors as `directions` does, for |angle| ≤ max_small_angle.
template <class T>
VITREL_INLINE void small_angle_directions(const T& angle, T& x, T& y) {
  const T square = angle * angle;
  x = detail::cosine_series<T>(square);
  y = detail::sine_series<T>(angle, square);
}

}  // namespace vitrel
