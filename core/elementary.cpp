#include "core/elementary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace vitrel {

namespace {

constexpr double ln2_high = 0x1.62e42fefa38p-1,
                 ln2_low = 0x1.ef35793c7673p-45;  // k · ln2_high is exact

// Returns eʳ − 1 for |r| ≤ ln 2/2.
double exponential_series(double r) {
  double sum = 1. / 87178291200;  // 1/14!
  double factorial = 6227020800;
  for (int n = 13; n >= 2; --n) {
    sum = 1 / factorial + r * sum;
    factorial /= n;
  }
  return r + r * r * sum;
}

// Returns the angle reduced to between −π and π, for |angle| ≤ 2⁵³. The number of turns is split into two halves, whose
// products with the parts of 2π are exact; their sum is kept as an unevaluated sum of two doubles.
double without_turns(double angle) {
  constexpr double parts[] = {0x1.921fb5p+2, 0x1.110b46p-24, 0x1.1a6262p-52, 0x1.3145c0p-76,
                              0x1.b839a2p-102};  // parts of 2π, 26 bits each
  constexpr double split = 0x1p27;
  const double turns = std::nearbyint(angle * (0.5 * std::numbers::inv_pi));
  const double high = split * std::nearbyint(turns / split), low = turns - high;
  double sum = angle, rest = 0;
  const auto subtract = [&](double product) {
    const double next = sum - product, back = next - sum;
    rest += (sum - (next - back)) - (product + back);
    sum = next;
  };
  for (const double part : parts) {
    subtract(high * part);
    subtract(low * part);
  }
  return sum + rest;
}

}  // namespace

CosineAndSine cosine_and_sine(double angle) {
  constexpr double largest = 0x1p53;
  if (!(std::abs(angle) <= largest))
    angle = std::fmod(angle, 2 * std::numbers::pi);  // exact; NaN for ∞
  if (!(std::abs(angle) < detail::max_reducible_angle)) angle = without_turns(angle);
  CosineAndSine result;
  detail::reduced_cosine_and_sine<double>(angle, result.cosine, result.sine);
  return result;
}

// With x = 2ᵏ (1 + f), √½ ≤ 1 + f < √2 and s = f/(2 + f), the function evaluates
//
//     ln(1 + f) = f − f²/2 + s (f²/2 + R),   R = 2/3 s² + 2/5 s⁴ + …
double logarithm(double x) {
  using Limits = std::numeric_limits<double>;
  if (!(x >= Limits::min() && x <= Limits::max())) {
    constexpr int digits = Limits::digits;
    if (x > 0 && x < 1) return logarithm(std::ldexp(x, digits)) - digits * std::numbers::ln2;
    if (x == 0) return -Limits::infinity();
    return x > 0 ? x : Limits::quiet_NaN();
  }
  constexpr int fraction_bits = 52;
  const auto bits = std::bit_cast<std::int64_t>(x);
  const auto k = (bits - std::bit_cast<std::int64_t>(std::numbers::sqrt2 / 2)) >> fraction_bits;
  const double f = std::bit_cast<double>(bits - (k << fraction_bits)) - 1;
  const double s = f / (2 + f), half_square = 0.5 * f * f;
  // The polynomial is split into independent parts (Estrin's scheme).
  const double z = s * s, z2 = z * z, z4 = z2 * z2;
  const double part1 = 2. / 3 + z * (2. / 5), part2 = 2. / 7 + z * (2. / 9);
  const double part3 = 2. / 11 + z * (2. / 13), part4 = 2. / 15 + z * (2. / 17);
  const double part5 = 2. / 19 + z * (2. / 21);
  const double r = z * ((part1 + z2 * part2) + z4 * ((part3 + z2 * part4) + z4 * part5));
  const auto exponent = static_cast<double>(k);
  return exponent * ln2_high - ((half_square - (s * (half_square + r) + exponent * ln2_low)) - f);
}

double logarithm_of_one_plus(double x) {
  const double sum = 1 + x;
  if (!(sum > 0 && sum <= std::numeric_limits<double>::max())) return logarithm(sum);
  return logarithm(sum) - ((sum - 1) - x) / sum;
}

double exponential(double x) {
  constexpr double too_large = 710, too_small = -746;
  if (!(x < too_large)) return x > 0 ? std::numeric_limits<double>::infinity() : x;
  if (x < too_small) return 0;
  const double k = std::nearbyint(x * std::numbers::log2e);
  const double r = (x - k * ln2_high) - k * ln2_low;
  return std::ldexp(1 + exponential_series(r), static_cast<int>(k));
}

double exponential_minus_one(double x) {
  return std::abs(x) < std::numbers::ln2 / 2 ? exponential_series(x) : exponential(x) - 1;
}

// An approximation within 2e-3 is corrected by the angle between it and the vector, whose sine is d: asin d is expanded
// to the seventh power.
double polar_angle(double y, double x) {
  const double a = std::abs(x), b = std::abs(y), larger = std::max(a, b);
  if (larger == 0) return 0;
  const double p = a / larger, q = b / larger, t = std::min(p, q);
  const double within = t * (std::numbers::pi / 4 + (1 - t) * (0.2447 + 0.0663 * t));
  const double near = q <= p ? within : std::numbers::pi / 2 - within;
  const auto [cosine, sine] = cosine_and_sine(near);
  const double d = (q * cosine - p * sine) / std::sqrt(p * p + q * q), dd = d * d;
  const double angle = near + (d + d * dd * (1. / 6 + dd * (3. / 40 + dd * (15. / 336))));
  return std::copysign(x < 0 ? std::numbers::pi - angle : angle, y);
}

namespace {

// Dividing the bits of x by three divides its exponent by three, which gives the root to within 5 %. Each Halley step
// cubes this error.
double cubic_root_of_normal(double x) {
  constexpr std::int64_t bias = std::int64_t{715094163}
                                << 32;  // two thirds of the exponent's bias (FreeBSD's cbrt)
  double near = std::bit_cast<double>(std::bit_cast<std::int64_t>(x) / 3 + bias);
  for (int step = 0; step < 3; ++step) {
    const double cube = near * near * near;
    near *= (cube + 2 * x) / (2 * cube + x);
  }
  const double square = near * near;
  return near - (near * square - x) / (3 * square);
}

}  // namespace

double root(double x, int n) {
  if (n == 2) return std::sqrt(x);
  if (x == 0 || !std::isfinite(x)) return x;
  // The argument is reduced to between 1/2 and 4, so that the root of 8 x is exactly twice the root of x.
  int exponent;
  const double significand = std::frexp(std::abs(x), &exponent);
  const int third = (exponent + 3000) / 3 - 1000;
  const double root = cubic_root_of_normal(std::ldexp(significand, exponent - 3 * third));
  return std::copysign(std::ldexp(root, third), x);
}

namespace {

/// Returns Σ c_k x^(n − 1 − k): the coefficient of the highest power comes first.
template <std::size_t n>
double polynomial(const double (&c)[n], double x) {
  double sum = c[0];
  for (std::size_t k = 1; k < n; ++k) sum = sum * x + c[k];
  return sum;
}

constexpr double middle_over[] = {2.5090809287301226727e+3, 3.3430575583588128105e+4,
                                  6.7265770927008700853e+4, 4.5921953931549871457e+4,
                                  1.3731693765509461125e+4, 1.9715909503065514427e+3,
                                  1.3314166789178437745e+2, 3.3871328727963666080e+0};
constexpr double middle_under[] = {5.2264952788528545610e+3, 2.8729085735721942674e+4,
                                   3.9307895800092710610e+4, 2.1213794301586595867e+4,
                                   5.3941960214247511077e+3, 6.8718700749205790830e+2,
                                   4.2313330701600911252e+1, 1.0};
constexpr double tail_over[] = {7.74545014278341407640e-4, 2.27238449892691845833e-2,
                                2.41780725177450611770e-1, 1.27045825245236838258e+0,
                                3.64784832476320460504e+0, 5.76949722146069140550e+0,
                                4.63033784615654529590e+0, 1.42343711074968357734e+0};
constexpr double tail_under[] = {1.05075007164441684324e-9, 5.47593808499534494600e-4,
                                 1.51986665636164571966e-2, 1.48103976427480074590e-1,
                                 6.89767334985100004550e-1, 1.67638483018380384940e+0,
                                 2.05319162663775882187e+0, 1.0};
constexpr double far_over[] = {2.01033439929228813265e-7, 2.71155556874348757815e-5,
                               1.24266094738807843860e-3, 2.65321895265761230930e-2,
                               2.96560571828504891230e-1, 1.78482653991729133580e+0,
                               5.46378491116411436990e+0, 6.65790464350110377720e+0};
constexpr double far_under[] = {2.04426310338993978564e-15, 1.42151175831644588870e-7,
                                1.84631831751005468180e-5,  7.86869131145613259100e-4,
                                1.48753612908506148525e-2,  1.36929880922735805310e-1,
                                5.99832206555887937690e-1,  1.0};

}  // namespace

double normal_quantile(double u) {
  const double from_middle = u - 0.5;
  if (std::abs(from_middle) <= 0.425) {
    const double r = 0.180625 - from_middle * from_middle;
    return from_middle * polynomial(middle_over, r) / polynomial(middle_under, r);
  }
  const double r = std::sqrt(-logarithm(from_middle < 0 ? u : 1 - u));
  const double size = r <= 5 ? polynomial(tail_over, r - 1.6) / polynomial(tail_under, r - 1.6)
                             : polynomial(far_over, r - 5) / polynomial(far_under, r - 5);
  return std::copysign(size, from_middle);
}

}  // namespace vitrel
