#pragma once

/// @file
/// Elementary functions whose results are bit-identical on every processor. Everything that a trajectory depends on
/// uses them, because the functions of a C library may differ between processors: glibc selects variants with fused
/// multiply-add where the processor has it, and these round differently. Sum, product, quotient and square root are
/// rounded identically everywhere, and so are these functions, which use nothing else (expressions are not contracted:
/// -ffp-contract=off). Errors are in units in the last place of the result unless stated otherwise.
namespace vitrel {

namespace detail {

// Taylor series of sine and cosine for |x| ≤ π/2, accurate to 2e-17 and split into independent parts (Estrin's scheme);
// xx = x².
template <class T>
[[gnu::always_inline]] inline T sine_series(const T& x, const T& xx) {
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
[[gnu::always_inline]] inline T cosine_series(const T& xx) {
  const T x4 = xx * xx;
  const T part1 = 1. / 24 - 1. / 720 * xx;
  const T part2 = 1. / 40320 - 1. / 3628800 * xx;
  const T part3 = 1. / 479001600 - 1. / 87178291200 * xx;
  const T part4 = 1. / 20922789888000 - 1. / 6402373705728000 * xx;
  const T x8 = x4 * x4;
  const T part5 = x8 * (1. / 2432902008176640000);
  return (1 - 0.5 * xx) + x4 * ((part1 + x4 * part2) + x8 * ((part3 + x4 * part4) + part5));
}

/// `reduced_cosine_and_sine` requires |angle| below this limit: from there on, subtracting multiples of π is no longer
/// exact.
constexpr double max_reducible_angle = 1e6;
template <class T>
[[gnu::always_inline]] inline void reduced_cosine_and_sine(const T& angle, T& cosine, T& sine) {
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
  const T sign = 1 - 2 * (odd * odd);
  const T square = rest * rest;
  cosine = sign * cosine_series<T>(square);
  sine = sign * sine_series<T>(rest, square);
}

}  // namespace detail

/// Cosine and sine to within 4 units in the last place of 1, for |angle| ≤ 2⁵³. Beyond that, neighbouring doubles are
/// more than a radian apart.
struct CosineAndSine {
  double cosine, sine;
};
CosineAndSine cosine_and_sine(double angle);

/// ln x to within 1 unit; −∞ for x = 0 and NaN for x < 0.
double logarithm(double x);
/// ln(1 + x) to within 3 units.
double logarithm_of_one_plus(double x);
/// eˣ to within 1 unit if the result is a normal number.
double exponential(double x);
/// eˣ − 1 to within 4 units.
double exponential_minus_one(double x);
/// The angle of the vector (x, y), from −π to π, to within 3 units; 0 for the zero vector.
double polar_angle(double y, double x);
/// The square root (n = 2) or the cube root (n = 3) of x to within 1 unit. The root of 4ᵏ x or 8ᵏ x is exactly 2ᵏ times
/// the root of x.
double root(double x, int n);
/// The quantile of the standard normal distribution: a normal variable lies below it with probability u, 0 < u < 1. It
/// is accurate to 10⁻¹⁵ of the larger of its size and 1, by rational approximations (wichura1988).
double normal_quantile(double u);
/// xⁿ for n ≥ 0, by n products.
template <class T>
constexpr T power(T x, int n) {
  T result = 1;
  for (int k = 0; k < n; ++k) result *= x;
  return result;
}

}  // namespace vitrel
