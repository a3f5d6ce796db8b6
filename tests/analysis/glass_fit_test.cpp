#include "analysis/glass/glass_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/random/stream.h"

namespace vitrel {
namespace {

std::vector<double> densities(double from, double step, int count) {
  std::vector<double> result;
  for (int k = 0; k < count; ++k) result.push_back(from + step * k);
  return result;
}

/// Times by ln τ = y(φ), scattered by their relative error (in the logarithm).
template <class Y>
std::vector<GlassPoint> times(const std::vector<double>& packing_fractions, double relative_error,
                              Stream& draw, Y&& y) {
  std::vector<GlassPoint> points;
  for (const double phi : packing_fractions) {
    const double time = std::exp(y(phi) + relative_error * draw.normal());
    points.push_back({phi, time, relative_error * time});
  }
  return points;
}

double power_law(double phi) {
  return 1.5 - 2.3 * std::log(0.79 - phi);
}
double vogel_fulcher_law(double phi) {
  return -1 + 0.8 * phi / (0.83 - phi);
}

/// How often φ_c lies within one and two errors.
struct Coverage {
  int found = 0, one = 0, two = 0, statistical_one = 0, strength_one = 0;

  void count(const GlassFit& fit, double density, double strength) {
    if (fit.verdict != GlassVerdict::found) return;
    ++found;
    const double distance = std::abs(fit.density - density);
    one += distance < fit.error;
    two += distance < 2 * fit.error;
    statistical_one += distance < fit.statistical;
    strength_one += std::abs(fit.strength - strength) < fit.strength_error;
  }
};

// Binomial counts within 3 standard deviations, false-alarm rate 0.3 % each: the statistical error alone
// covers 68.27 ± 4.65 %. With the spread it covers more (about 90 %) if the law holds everywhere, as it
// has to allow for windows that leave densities out.
TEST(GlassFit, ErrorsCoverTheDensityOfThePowerLaw) {
  Coverage coverage;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Stream draw(seed, Purpose::tests);
    coverage.count(fit_glass_law(times(densities(0.60, 0.02, 9), 0.05, draw, power_law),
                                 GlassLaw::mode_coupling),
                   0.79, 2.3);
  }
  EXPECT_GE(coverage.found, 90);
  EXPECT_NEAR(coverage.statistical_one, 0.6827 * coverage.found, 3 * 4.65);
  EXPECT_GE(coverage.strength_one, 0.6827 * coverage.found - 3 * 4.65);
  EXPECT_GE(coverage.one, 0.6827 * coverage.found - 3 * 4.65);
  EXPECT_GE(coverage.two, 0.954 * coverage.found - 3 * 2.1);
}

TEST(GlassFit, ErrorsCoverTheDensityOfVogelAndFulcher) {
  Coverage coverage;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Stream draw(seed, Purpose::tests);
    coverage.count(fit_glass_law(times(densities(0.60, 0.02, 9), 0.05, draw, vogel_fulcher_law),
                                 GlassLaw::vogel_fulcher),
                   0.83, 0.8);
  }
  EXPECT_GE(coverage.found, 90);
  EXPECT_NEAR(coverage.statistical_one, 0.6827 * coverage.found, 3 * 4.65);
  EXPECT_GE(coverage.two, 0.954 * coverage.found - 3 * 2.1);
}

// Below 0.62 times stay above the power law (no caging yet), by 4σ and more: these densities stay
// outside of the window, and the error covers φ_c.
TEST(GlassFit, DensitiesBelowThePowerLawStayOutside) {
  Coverage coverage;
  int low = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Stream draw(seed, Purpose::tests);
    const auto y = [](double phi) { return power_law(phi) + 15 * std::max(0.0, 0.62 - phi); };
    const GlassFit fit =
        fit_glass_law(times(densities(0.56, 0.02, 11), 0.05, draw, y), GlassLaw::mode_coupling);
    coverage.count(fit, 0.79, 2.3);
    low += fit.window.lowest < 0.59;
  }
  EXPECT_LE(low, 5);
  EXPECT_GE(coverage.found, 90);
  EXPECT_GE(coverage.one, 0.6827 * coverage.found - 3 * 4.65);
  EXPECT_GE(coverage.two, 0.954 * coverage.found - 3 * 2.1);
}

// Above 0.75 times stay below the power law (hopping). With a φ_c that is too high the law bends so
// that χ² often finds nothing to blame; the windows contradict each other, and the spread says so.
TEST(GlassFit, DensitiesBeyondThePowerLawMakeTheErrorLarge) {
  Coverage coverage;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Stream draw(seed, Purpose::tests);
    const auto y = [](double phi) { return power_law(phi) - 40 * std::max(0.0, phi - 0.75); };
    coverage.count(
        fit_glass_law(times(densities(0.58, 0.02, 11), 0.05, draw, y), GlassLaw::mode_coupling),
        0.79, 2.3);
  }
  EXPECT_GE(coverage.found, 80);
  EXPECT_GE(coverage.one, 0.6827 * coverage.found - 3 * 4.65);
  EXPECT_GE(coverage.two, 0.954 * coverage.found - 3 * 2.1);
}

// Far from φ_c a power law cannot be told from an exponential: no φ_c, a bound that holds in 95 % of
// the cases (3 binomial standard deviations), or a refusal.
TEST(GlassFit, FarFromTheDivergenceThereIsABoundOnly) {
  int found = 0, bounds = 0, wrong = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Stream draw(seed, Purpose::tests);
    const GlassFit fit = fit_glass_law(times(densities(0.50, 0.02, 6), 0.1, draw, power_law),
                                       GlassLaw::mode_coupling);
    found += fit.verdict == GlassVerdict::found;
    bounds += fit.verdict == GlassVerdict::lower_bound;
    wrong += fit.verdict == GlassVerdict::lower_bound && fit.least > 0.79;
  }
  EXPECT_GE(bounds, 50);
  EXPECT_LE(wrong, 5 + 3 * 2.2);
}

// Above 0.70 times grow more slowly than by the law of a divergence at 0.72: what relaxes at 0.76 is not
// beyond it, whatever the windows below 0.70 say. The power law is free to be crossed.
TEST(GlassFit, NoDivergenceIsBelowADensityThatRelaxes) {
  Stream draw(1, Purpose::tests);
  const auto y = [](GlassLaw law) {
    return [law](double phi) {
      return phi <= 0.7 ? glass_law(law, 1, 0.5, 0.72, phi)
                        : glass_law(law, 1, 0.5, 0.72, 0.7) + 20 * (phi - 0.7);
    };
  };
  const auto fit = [&](GlassLaw law) {
    return fit_glass_law(times(densities(0.60, 0.02, 9), 0.05, draw, y(law)), law);
  };
  for (const GlassWindow& window : fit(GlassLaw::vogel_fulcher).windows)
    EXPECT_FALSE(window.density < 0.76) << window.highest;
  double lowest = 1;
  for (const GlassWindow& window : fit(GlassLaw::mode_coupling).windows)
    lowest = std::min(lowest, window.density);
  EXPECT_LT(lowest, 0.76);
}

// Without noise the parameters come out to rounding, and the covariance is that of the curvature:
// the interval of a parabola, low … high, is 2σ wide as σ → 0.
TEST(GlassFit, WithoutNoiseTheLawIsFoundExactly) {
  Stream draw(1, Purpose::tests);
  for (const GlassLaw law : {GlassLaw::mode_coupling, GlassLaw::vogel_fulcher}) {
    std::vector<GlassPoint> points;
    for (const double phi : densities(0.60, 0.02, 9)) {
      const double time = std::exp(glass_law(law, 1.5, 0.9, 0.81, phi));
      points.push_back({phi, time, 1e-4 * time});
    }
    const GlassFit fit = fit_glass_law(points, law);
    ASSERT_EQ(fit.verdict, GlassVerdict::found) << fit.reason;
    EXPECT_NEAR(fit.density, 0.81, 1e-8);
    EXPECT_NEAR(fit.strength, 0.9, 1e-6);
    EXPECT_NEAR(fit.window.log_prefactor, 1.5, 1e-6);
    EXPECT_EQ(fit.window.densities, 9u);
    EXPECT_EQ(fit.windows.size(), 15u);
    EXPECT_LT(fit.low, 0.81);
    EXPECT_GT(fit.high, 0.81);
    EXPECT_LT(fit.error, 1e-4);
    EXPECT_NEAR(std::sqrt(fit.window.covariance(2, 2)) / fit.statistical, 1, 0.01);
  }
  EXPECT_NEAR(glass_law(GlassLaw::mode_coupling, 1.5, 2.3, 0.79, 0.7), power_law(0.7), 1e-12);
  EXPECT_NEAR(glass_law(GlassLaw::vogel_fulcher, -1, 0.8, 0.83, 0.7), vogel_fulcher_law(0.7),
              1e-12);
}

// Two seeds ±d apart in ln τ with errors e, at nine densities: S² = 2 d²/e² per degree of freedom.
TEST(GlassFit, SeedsThatScatterMoreThanTheirErrorsMakeThemLarger) {
  std::vector<GlassPoint> points;
  for (const double phi : densities(0.60, 0.02, 9))
    for (const double sign : {-1.0, 1.0}) {
      const double time = std::exp(power_law(phi) + sign * 0.03);
      points.push_back({phi, time, 0.01 * time});
    }
  const GlassFit fit = fit_glass_law(points, GlassLaw::mode_coupling);
  EXPECT_NEAR(fit.scatter, std::sqrt(2) * 3, 1e-6);
  EXPECT_EQ(fit.window.densities, 9u);
  EXPECT_NEAR(fit.density, 0.79, 1e-6);
  for (GlassPoint& p : points) p.error *= std::sqrt(2) * 3;
  EXPECT_NEAR(fit_glass_law(points, GlassLaw::mode_coupling).statistical, fit.statistical,
              1e-6 * fit.statistical);
}

TEST(GlassFit, DataThatDoNotSupportAFitAreRefusedWithTheReason) {
  Stream draw(1, Purpose::tests);
  const auto reason = [](const std::vector<GlassPoint>& points) {
    const GlassFit fit = fit_glass_law(points, GlassLaw::mode_coupling);
    EXPECT_EQ(fit.verdict, GlassVerdict::refused);
    return fit.reason;
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(reason({}), "0 densities in equilibrium"));
  EXPECT_TRUE(has(reason(times(densities(0.6, 0.02, 4), 0.05, draw, power_law)), "4 densities"));
  // Five runs, but only two densities.
  EXPECT_TRUE(has(reason(times({0.6, 0.6, 0.6, 0.7, 0.7}, 0.05, draw, power_law)), "2 densities"));
  EXPECT_TRUE(
      has(reason(times(densities(0.6, 0.02, 6), 1e-3, draw, [](double phi) { return -10 * phi; })),
          "do not grow"));
  EXPECT_TRUE(has(reason(times(densities(0.6, 0.02, 6), 1e-3, draw,
                               [](double phi) { return std::sin(100 * phi); })),
                  "in no window"));
  // They diverge at the highest density itself, but for 5e-7.
  EXPECT_TRUE(has(reason(times(densities(0.62, 0.02, 5), 0.3, draw,
                               [](double phi) { return -std::log(0.7000005 - phi); })),
                  "not distinct"));
}

TEST(GlassFit, PointsWithoutTimeOrErrorAreTheUsersMistake) {
  for (const GlassPoint& p : {GlassPoint{0.7, std::nan(""), 1},
                              {0.7, 1, 0},
                              {0.7, -1, 1},
                              {0.7, 1, std::nan("")},
                              {1.2, 1, 1}})
    EXPECT_THROW(fit_glass_law({p}, GlassLaw::mode_coupling), UserError);
}

}  // namespace
}  // namespace vitrel
