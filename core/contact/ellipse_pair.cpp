#include "core/contact/ellipse_pair.h"

#include <cmath>

namespace vitrel {
namespace {

/// Beyond, a multiple of π is no longer taken off exactly.
constexpr double largest_reduced = 1e6;

// The series of sine and cosine for |x| ≤ π/2, to 2e-17, in parts that need not wait for each other
// (Estrin's scheme). xx = x².
Lanes sine_series(const Lanes& x, const Lanes& xx) {
  const Lanes x4 = xx * xx;
  const Lanes part1 = 1. / 120 * xx - 1. / 6;
  const Lanes part2 = 1. / 362880 * xx - 1. / 5040;
  const Lanes part3 = 1. / 6227020800 * xx - 1. / 39916800;
  const Lanes part4 = 1. / 355687428096000 * xx - 1. / 1307674368000;
  const Lanes part5 = 1. / 51090942171709440000. * xx - 1. / 121645100408832000;
  const Lanes x8 = x4 * x4;
  return x + x * xx * ((part1 + x4 * part2) + x8 * ((part3 + x4 * part4) + x8 * part5));
}

Lanes cosine_series(const Lanes& xx) {
  const Lanes x4 = xx * xx;
  const Lanes part1 = 1. / 24 - 1. / 720 * xx;
  const Lanes part2 = 1. / 40320 - 1. / 3628800 * xx;
  const Lanes part3 = 1. / 479001600 - 1. / 87178291200 * xx;
  const Lanes part4 = 1. / 20922789888000 - 1. / 6402373705728000 * xx;
  const Lanes x8 = x4 * x4;
  const Lanes part5 = x8 * (1. / 2432902008176640000);
  return (1 - 0.5 * xx) + x4 * ((part1 + x4 * part2) + x8 * ((part3 + x4 * part4) + part5));
}

}  // namespace

void small_directions(const Lanes& angle, Lanes& x, Lanes& y) {
  const Lanes square = angle * angle;
  x = cosine_series(square);
  y = sine_series(angle, square);
}

void directions(const Lanes& angle, Lanes& x, Lanes& y) {
  if (!(angle.abs().maxCoeff() < largest_reduced)) {
    x = {std::cos(angle[0]), std::cos(angle[1])};
    y = {std::sin(angle[0]), std::sin(angle[1])};
    return;
  }
  // Adding and subtracting this rounds to a whole number. π is taken off in three parts; a multiple
  // of the first is exact.
  constexpr double rounder = 0x1.8p52;
  constexpr double pi_high = 0x1.921fb544p1;
  constexpr double pi_middle = 0x1.0b4611a6p-33;
  constexpr double pi_low = 0x1.3198a2e037073p-68;
  const Lanes k = (angle * 0.31830988618379067154 + rounder) - rounder;
  const Lanes rest = ((angle - k * pi_high) - k * pi_middle) - k * pi_low;
  const Lanes half = (0.5 * k + rounder) - rounder;
  const Lanes sign = 1 - 2 * (k - 2 * half).abs();
  const Lanes square = rest * rest;
  x = sign * cosine_series(square);
  y = sign * sine_series(rest, square);
}

}  // namespace vitrel
