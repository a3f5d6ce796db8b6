#include "core/extended.h"

#include <array>
#include <numbers>

#include "core/elementary.h"

namespace vitrel {
namespace {

/// 1/n! up to n = 29. The first neglected terms of the series are below 2⁻¹¹⁸ for |x| ≤ π/4.
constexpr auto inverse_factorials = [] {
  std::array<DoubleDouble, 30> inverse;
  inverse[0] = 1;
  for (int n = 1; n < 30; ++n) inverse[n] = inverse[n - 1] / n;
  return inverse;
}();

}  // namespace

std::pair<DoubleDouble, DoubleDouble> extended_cosine_and_sine(double angle) {
  constexpr double half_pi[] = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54,
                                -0x1.f1976b7ed8fbcp-110};
  if (!(std::abs(angle) <= 0x1p53)) {
    const auto [cosine, sine] = cosine_and_sine(angle);
    return {cosine, sine};
  }
  // Whole quarter turns are subtracted. The second pass is needed for angles so large that the first misses the nearest
  // number.
  DoubleDouble rest = angle;
  int quarters = 0;
  for (int pass = 0; pass < 2; ++pass) {
    const double turns = std::nearbyint(static_cast<double>(rest) * (2 * std::numbers::inv_pi));
    for (const double part : half_pi) rest -= DoubleDouble::product(turns, part);
    quarters += static_cast<int>(std::fmod(turns, 4));
  }
  const DoubleDouble square = rest * rest, sign = (quarters & 2) == 0 ? 1 : -1;
  DoubleDouble cosine = 0, sine = 0;
  for (int n = 28; n >= 0; n -= 2) {
    cosine = inverse_factorials[n] - square * cosine;
    sine = inverse_factorials[n + 1] - square * sine;
  }
  cosine *= sign, sine *= sign * rest;
  if ((quarters & 1) != 0) return {-sine, cosine};
  return {cosine, sine};
}

}  // namespace vitrel
