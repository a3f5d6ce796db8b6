#include "analysis/dynamics/haff.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vitrel {
namespace {

struct Series {
  std::vector<double> time, temperature;
};

/// T = 3/(1 + t/7)ⁿ from t = 0 to `last`, sampled as a run of logarithmic output is.
Series cooling(double exponent, double last) {
  Series series{{0}, {3}};
  for (double t = 0.1; t <= last; t *= 1.5) {
    series.time.push_back(t);
    series.temperature.push_back(3 / std::pow(1 + t / 7, exponent));
  }
  return series;
}

TEST(Haff, LawIsFoundAgain) {
  for (const double exponent : {2.0, 5.0 / 3}) {
    const Series series = cooling(exponent, 200);
    const auto law = fit_haff(series.time, series.temperature, exponent);
    ASSERT_TRUE(law);
    EXPECT_EQ(law->initial, 3);
    EXPECT_NEAR(law->time, 7, 1e-12);
    EXPECT_NEAR((*law)(21), 3 / std::pow(4, exponent), 1e-12);
  }
}

TEST(Haff, OnlyTheFirstDecayIsFitted) {
  // T falls to 3/e at t = 7 (√e − 1) = 4.5; what comes after one colder sample does not count.
  Series series = cooling(2, 200);
  const auto law = fit_haff(series.time, series.temperature, 2);
  for (std::size_t k = 0; k < series.time.size(); ++k)
    if (series.time[k] > 1.5 * 4.6) series.temperature[k] = 1;
  EXPECT_EQ(fit_haff(series.time, series.temperature, 2)->time, law->time);
}

TEST(Haff, TimeBeginsWithTheFirstSample) {
  Series series = cooling(2, 200);
  for (double& t : series.time) t += 100;
  EXPECT_NEAR(fit_haff(series.time, series.temperature, 2)->time, 7, 1e-12);
}

TEST(Haff, ThereIsNoLawWithoutOneDecay) {
  const Series series = cooling(2, 4.5);
  EXPECT_FALSE(fit_haff(series.time, series.temperature, 2));
  EXPECT_FALSE(fit_haff({}, {}, 2));
}

}  // namespace
}  // namespace vitrel
