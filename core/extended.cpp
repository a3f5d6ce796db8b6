#include "core/extended.h"

#include <array>
#include <numbers>

#include "core/elementary.h"

namespace vitrel {
namespace {

/// 1/n! up to n = 29: of the series for |x| ≤ π/4, the next terms are below 2⁻¹¹⁸.
constexpr auto inverse_factorials = [] {
  std::array<DoubleDouble, 30> inverse;
  inverse[0] = 1;
  for (int n = 1; n < 30; ++n) inverse[n] = inverse[n - 1] / n;
  return inverse;
}();

/// The rest of the angle, at most π/4 but for rounding, and the number of quarter turns modulo 4 that it lacks. The
/// second pass is for angles so large that the first misses the nearest quarter turn.
struct ReducedAngle {
  DoubleDouble rest;
  int quarters = 0;

  explicit ReducedAngle(double angle) : rest(angle) {
    constexpr double half_pi[] = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54,
                                  -0x1.f1976b7ed8fbcp-110};
    for (int pass = 0; pass < 2; ++pass) {
      const double turns = std::nearbyint(static_cast<double>(rest) * (2 * std::numbers::inv_pi));
      for (const double part : half_pi) rest -= DoubleDouble::product(turns, part);
      quarters += static_cast<int>(std::fmod(turns, 4));
    }
  }
};

}  // namespace

ExtendedCosineAndSine extended_cosine_and_sine(double angle) {
  constexpr double largest = 0x1p53;
  if (!(std::abs(angle) <= largest)) {
    const auto [cosine, sine] = cosine_and_sine(angle);
    return {cosine, sine};
  }
  const ReducedAngle reduced(angle);
  const DoubleDouble square = reduced.rest * reduced.rest;
  DoubleDouble cosine = 0, sine = 0;
  for (int n = 28; n >= 0; n -= 2) {
    cosine = inverse_factorials[n] - square * cosine;
    sine = inverse_factorials[n + 1] - square * sine;
  }
  sine *= reduced.rest;
  switch (reduced.quarters & 3) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace vitrel
