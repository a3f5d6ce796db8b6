#include "analysis/dynamics/viscosity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/random/stream.h"
#include "core/special_values.h"
#include "tests/support/even_steps.h"

namespace vitrel {
namespace {

using Moments = std::vector<std::vector<double>>;

// G = 0, 1, 4, 9 and its double: changes over one interval 1, 3, 5, over two 4, 8, over three 9. With 1/(2 V kT) = 1/12
// the means over both elements are (1 + 9 + 25)/3 · 5/2 · 1/12, (16 + 64)/2 · 5/2 · 1/12 and 81 · 5/2 · 1/12.
TEST(Viscosity, MomentsByHand) {
  const Viscosity found = shear_viscosity(even_steps(0, 0.5, 4), {{0, 1, 4, 9}, {0, 2, 8, 18}},
                                          {3, 2, 0.5}, {.longest_lag = 1});
  EXPECT_EQ(found.lag, (std::vector<double>{0.5, 1, 1.5}));
  EXPECT_EQ(found.origins, (std::vector<std::size_t>{3, 2, 1}));
  EXPECT_NEAR(found.moment.value[0], 35. / 3 * 5 / 24, 1e-12);
  EXPECT_NEAR(found.moment.value[1], 40. * 5 / 24, 1e-12);
  EXPECT_NEAR(found.moment.value[2], 81. * 5 / 24, 1e-12);
  EXPECT_TRUE(std::isnan(found.shear.value));
  EXPECT_EQ(found.shear.reason, "the run is too short for an error");
}

/// The integral of a stress with the correlation exp(−t), sampled exactly: of an Ornstein and Uhlenbeck process x with
/// ⟨x²⟩ = 1, X = ∫x dt. ⟨ΔX²⟩ = 2 (t − 1 + exp(−t)), whose slope is 2.
std::vector<double> integrated_stress(std::size_t frames, double interval, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  const double kept = std::exp(-interval);
  // Noise of x, and that of X given it (gillespie1996).
  const double of_x = std::sqrt(1 - kept * kept);
  const double of_both = (1 - kept) * (1 - kept) / of_x;
  const double of_integral =
      std::sqrt(2 * interval - 3 + 4 * kept - kept * kept - of_both * of_both);
  double x = draw.normal(), integral = 0;
  std::vector<double> moment;
  for (std::size_t k = 0; k < frames; ++k) {
    moment.push_back(integral);
    const double first = draw.normal(), second = draw.normal();
    integral += x * (1 - kept) + of_both * first + of_integral * second;
    x = kept * x + of_x * first;
  }
  return moment;
}

// With V = 4 and kT = 1/2: η = 1/(2 V kT) · 2 = 1/2. 100 runs; the mean within 3.5 of its errors (false alarm: 0.05 %),
// and the ratio of scatter and stated error, which has an error of 7 %, within 0.75 and 1.25.
TEST(Viscosity, OfAStressThatDecaysIsKnown) {
  double sum = 0, squares = 0, stated = 0;
  constexpr int runs = 100;
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const Moments moments = {integrated_stress(4000, 0.5, 2 * seed),
                             integrated_stress(4000, 0.5, 2 * seed + 1)};
    const Viscosity found = shear_viscosity(even_steps(0, 0.5, 4000), moments, {4, 0.5, 6});
    ASSERT_EQ(found.shear.reason, "");
    EXPECT_DOUBLE_EQ(found.shear.from, 6);
    EXPECT_DOUBLE_EQ(found.shear.to, 18);
    sum += found.shear.value;
    squares += found.shear.value * found.shear.value;
    stated += found.shear.error * found.shear.error;
  }
  const double mean = sum / runs;
  const double scatter = std::sqrt((squares / runs - mean * mean) * runs / (runs - 1));
  const double error = std::sqrt(stated / runs);
  EXPECT_NEAR(mean, 0.5, 3.5 * scatter / std::sqrt(runs) + 0.5 * std::exp(-6) / 12);
  EXPECT_LT(scatter, 0.1);
  EXPECT_GT(scatter / error, 0.75);
  EXPECT_LT(scatter / error, 1.25);
}

TEST(Viscosity, IsRefusedWithTheReason) {
  const std::vector<double> even = even_steps(0, 0.5, 400);
  const Moments moments = {integrated_stress(400, 0.5, 1)};
  const auto reason = [&](const std::vector<double>& times, double relaxation_time) {
    const Viscosity found = shear_viscosity(times, moments, {1, 1, relaxation_time});
    EXPECT_TRUE(std::isnan(found.shear.value));
    EXPECT_TRUE(std::isnan(found.shear.error));
    return found.shear.reason;
  };
  using testing::HasSubstr;
  EXPECT_THAT(reason(even, unknown), HasSubstr("not moved by a unit of length"));
  EXPECT_THAT(reason(even, 50), HasSubstr("longest time difference is below three times"));
  EXPECT_THAT(reason(even, 500), HasSubstr("longest time difference is below three times"));
  EXPECT_THAT(reason(even, 30), HasSubstr("too short for an error"));
  std::vector<double> uneven = even;
  for (double& time : uneven) time *= time;
  EXPECT_THAT(reason(uneven, 6), HasSubstr("not evenly spaced"));
}

}  // namespace
}  // namespace vitrel
