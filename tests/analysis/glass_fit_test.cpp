#include "analysis/glass/glass_fit.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/error.h"
#include "core/random/stream.h"
#include "tests/support/coverage.h"
#include "tests/support/even_steps.h"

namespace vitrel {
namespace {

using testing::HasSubstr;

/// Times by ln τ = y(φ), without noise.
template <class Y>
std::vector<GlassPoint> exact_times(const std::vector<double>& packing_fractions,
                                    double relative_error, Y&& y) {
  std::vector<GlassPoint> points;
  for (const double phi : packing_fractions) {
    const double time = std::exp(y(phi));
    points.push_back({phi, time, relative_error * time});
  }
  return points;
}

/// The same, scattered by their relative error (in the logarithm).
template <class Y>
std::vector<GlassPoint> times(const std::vector<double>& packing_fractions, double relative_error,
                              Stream& draw, Y&& y) {
  return exact_times(packing_fractions, relative_error,
                     [&](double phi) { return y(phi) + relative_error * draw.normal(); });
}

/// The fits to a hundred samples of such times.
template <class Y>
std::vector<GlassFit> sampled_fits(const std::vector<double>& packing_fractions,
                                   double relative_error, Y&& y,
                                   GlassLaw law = GlassLaw::mode_coupling) {
  std::vector<GlassFit> fits;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Stream draw(seed, Purpose::tests);
    fits.push_back(fit_glass_law(times(packing_fractions, relative_error, draw, y), law));
  }
  return fits;
}

/// The reason for which a law is refused; empty if it is not.
std::string refusal(const GlassFit& fit) {
  return fit.verdict == GlassVerdict::refused ? fit.reason : "";
}
std::string refusal(const std::vector<GlassPoint>& points, GlassLaw law = GlassLaw::mode_coupling) {
  return refusal(fit_glass_law(points, law));
}

double power_law(double phi) {
  return 1.5 - 2.4 * std::log(0.79 - phi);
}
double vogel_fulcher_law(double phi) {
  return -1 + 0.42 * phi / (0.82 - phi);
}

/// Nine densities over which both laws grow by three decades.
const std::vector<double> three_decades = even_steps(0.60, 0.022413, 9);
const std::vector<double> nine_densities = even_steps(0.60, 0.02, 9);

struct KnownLaw {
  GlassLaw law;
  double (*y)(double);
  double density, strength;
};

// The rules refuse few laws, and do not choose among them: the errors of what is found cover.
// Binomial counts within 3 standard deviations, false-alarm rate 0.3 % each.
TEST(GlassFit, ErrorsCoverTheDensityAndTheStrength) {
  for (const auto& [law, y, density, strength] :
       {KnownLaw{GlassLaw::mode_coupling, power_law, 0.79, 2.4},
        KnownLaw{GlassLaw::vogel_fulcher, vogel_fulcher_law, 0.82, 0.42}}) {
    Coverage of_density, of_strength;
    for (const GlassFit& fit : sampled_fits(three_decades, 0.05, y, law)) {
      if (fit.verdict != GlassVerdict::found) continue;
      of_density.count(fit.window.density - density, fit.window.error());
      of_strength.count(fit.window.strength - strength, fit.window.strength_error());
    }
    const int found = of_density.known + of_density.unknown;
    EXPECT_GE(found, 90);
    EXPECT_NEAR(of_density.one, 0.6827 * found, 3 * 4.65);
    EXPECT_GE(of_density.two, 0.954 * found - 3 * 2.1);
    EXPECT_NEAR(of_strength.one, 0.6827 * found, 3 * 4.65);
  }
}

/// A power law up to a density, and exponential growth as steep beyond: a liquid that crosses over.
double crossing_over(double phi) {
  constexpr double from = 0.75;
  return power_law(std::min(phi, from)) + 2.4 / (0.79 - from) * std::max(0.0, phi - from);
}

// All grow by about three decades, but for the last: a power law of the exponent 1.1 has 1.4 there.
TEST(GlassFit, OtherLawsAreNotTakenForThePowerLaw) {
  struct MadeUp {
    const char* name;
    std::vector<double> packing_fractions;
    double (*y)(double);
  };
  const MadeUp laws[] = {
      {"Vogel and Fulcher, near", three_decades,
       [](double phi) { return 0.27 * phi / (0.80 - phi); }},
      {"Vogel and Fulcher", three_decades, [](double phi) { return 0.81 * phi / (0.85 - phi); }},
      {"Vogel and Fulcher, far", three_decades, [](double phi) { return 1.6 * phi / (0.9 - phi); }},
      {"Arrhenius", three_decades, [](double phi) { return 40 * phi; }},
      {"crossing over", even_steps(0.60, 0.025, 9), crossing_over},
      {"exponent 1.1", three_decades, [](double phi) { return -1.1 * std::log(0.79 - phi); }}};
  for (const auto& [name, packing_fractions, y] : laws) {
    int found = 0;
    for (const GlassFit& fit : sampled_fits(packing_fractions, 0.05, y))
      found += fit.verdict == GlassVerdict::found;
    EXPECT_LE(found, 5) << name;
  }
}

// Below 0.62 times stay above the power law (no caging yet), by 15 · 0.06/0.05 = 18σ at 0.56. The best
// window leaves these densities out, so that its law contradicts them: no φ_c, and mostly the reason names
// the density that is missed by most. A window of few densities may leave its law so open that nothing contradicts
// it; such samples are to be as rare as deviations of 2σ.
TEST(GlassFit, DensitiesBelowThePowerLawContradictIt) {
  int refused = 0, named = 0;
  const auto y = [](double phi) { return power_law(phi) + 15 * std::max(0.0, 0.62 - phi); };
  for (const GlassFit& fit : sampled_fits(even_steps(0.56, 0.02, 11), 0.05, y)) {
    refused += !refusal(fit).empty();
    named += refusal(fit).find("misses the time at 0.56 by") != std::string::npos;
  }
  EXPECT_GE(refused, 95);
  EXPECT_GT(named, refused / 2);
}

// Above 0.75 times stay below the power law (hopping), by 40 · 0.01/0.05 = 8σ at 0.76 and 24σ at 0.78. Another
// power law, with φ_c = 0.802, adds only 8.8 to χ² of eight degrees of freedom, so that not all of these samples
// can be refused. With errors of 2 % it adds 55.
TEST(GlassFit, DensitiesBeyondThePowerLawContradictIt) {
  const auto found = [](double relative_error) {
    const auto y = [](double phi) { return power_law(phi) - 40 * std::max(0.0, phi - 0.75); };
    int count = 0;
    for (const GlassFit& fit : sampled_fits(even_steps(0.58, 0.02, 11), relative_error, y))
      count += refusal(fit).empty();
    return count;
  };
  EXPECT_LE(found(0.05), 30);
  EXPECT_LE(found(0.02), 5);
}

// Times that follow the law exactly but for the exponent; the error of s is 1e-3 of it or so.
TEST(GlassFit, AnExponentThatModeCouplingTheoryForbidsIsNone) {
  const auto refusal_of = [](double exponent) {
    return refusal(exact_times(three_decades, 1e-3,
                               [&](double phi) { return -exponent * std::log(0.79 - phi); }));
  };
  EXPECT_THAT(refusal_of(1.1), HasSubstr("the exponent is below 1.1 with a probability of 95 %"));
  EXPECT_THAT(refusal_of(1.75), HasSubstr("the exponent is below 1.75 "));
  EXPECT_EQ(refusal_of(1.764), "");  // its limit of 95 % is above 1.765
}

// φ_c = 0.79 holds up to 0.70, times three times as long at two densities beyond. They grow by
// (0.19/0.09)^2.4 = 6.0 in the window that is left.
TEST(GlassFit, ADecadeMustLieWithinTheWindow) {
  const auto y = [](double phi) { return power_law(phi) + (phi > 0.705 ? 1.1 : 0); };
  EXPECT_THAT(
      refusal(exact_times(even_steps(0.60, 0.02, 8), 1e-3, y)),
      HasSubstr("within the best window, [0.6, 0.7], the times grow by a factor of only 6"));
}

// The crossing-over liquid, with many densities and without noise, so that χ² finds nothing to blame.
TEST(GlassFit, ADensityThatFollowsTheEndOfTheWindowIsNone) {
  EXPECT_THAT(refusal(exact_times(even_steps(0.60, 0.18 / 19, 20), 0.07, crossing_over)),
              HasSubstr("phi_c follows the end of the window: it is 0.8112 up to 0.78, but 0.79"));
}

// Exact times by one law, whose χ² is 0. They grow by 70, and with errors of 5 % χ² of the other one is 2.8.
TEST(GlassFit, TheDataMustTellTheLawsApart) {
  const auto refusal_of = [](double relative_error) {
    return refusal(exact_times(nine_densities, relative_error, power_law));
  };
  EXPECT_THAT(refusal_of(0.05), HasSubstr("chi^2 is 0.00 by this one and 2.82 by the other"));
  EXPECT_EQ(refusal_of(0.01), "");
}

// The same with a distinction of 5.4, which times drawn anew halve.
TEST(GlassFit, TheVerdictMustSurviveTheErrorsOfTheTimes) {
  EXPECT_THAT(refusal(exact_times(nine_densities, 0.036, power_law)),
              HasSubstr("does not survive the errors of the times"));
}

// An outlier beyond the window, at 0.78 and 5σ below the law that all others obey exactly: the law of the
// window is known so well that the distance is that in errors of the time alone.
TEST(GlassFit, ADensityOutsideTheWindowIsComparedWithTheExtrapolatedLaw) {
  std::vector<GlassPoint> points = exact_times(nine_densities, 1e-4, power_law);
  const double time = std::exp(power_law(0.78) - 5 * 0.1);
  points.push_back({0.78, time, 0.1 * time});
  EXPECT_THAT(refusal(points),
              HasSubstr("the law of the best window, [0.6, 0.76], misses the time at 0.78 by 5 "));
  points.back() = {0.80, time, 0.1 * time};
  EXPECT_THAT(refusal(points),
              HasSubstr("times at 0.8 are finite, beyond the phi_c = 0.79 of the best window"));
}

// (0.95 − φ)^−10 grows by a factor of 12 from 0.50 to 0.60, so far from φ_c that a power law cannot be told
// from an exponential: mostly a bound. Bounds, and both limits of the few φ_c, hold in 95 % of the cases (3 binomial
// standard deviations).
TEST(GlassFit, FarFromTheDivergenceThereIsABoundOnly) {
  int bounds = 0, wrong = 0;
  const auto y = [](double phi) { return -10 * std::log(0.95 - phi); };
  for (const GlassFit& fit : sampled_fits(even_steps(0.50, 0.02, 6), 0.1, y)) {
    const bool is_bound = fit.verdict == GlassVerdict::lower_bound;
    bounds += is_bound;
    wrong += is_bound && fit.window.least > 0.95;
    wrong +=
        fit.verdict == GlassVerdict::found && (fit.window.low > 0.95 || fit.window.high < 0.95);
  }
  EXPECT_GE(bounds, 50);
  EXPECT_LE(wrong, 5 + 3 * 2.2);
}

// Exact times of the power law with φ_c = 0.82, but errors so large that φ_c is not bounded from above and,
// with a probability of more than 5 %, not above the highest density.
TEST(GlassFit, ABoundBelowTheHighestDensityIsNone) {
  for (const double relative_error : {0.8, 0.9}) {
    const auto points = exact_times(even_steps(0.70, 0.02, 5), relative_error,
                                    [](double phi) { return -2.5 * std::log(0.82 - phi); });
    const GlassFit fit = fit_glass_law(points, GlassLaw::mode_coupling);
    EXPECT_GT(fit.window.low, 0.78) << relative_error;
    EXPECT_TRUE(std::isnan(fit.window.high)) << relative_error;
    EXPECT_EQ(fit.verdict, GlassVerdict::refused) << relative_error;
    EXPECT_EQ(fit.reason,
              "the density at which times diverge is not distinct from the highest one, 0.78");
  }
}

// The power law grows by (0.29/0.19)^2.4 = 2.76 from 0.50 to 0.60. Exact times fit it perfectly, and yet
// hardly more than a straight line is known. From 0.60 to 0.716 it is (0.19/0.074)^2.4 = 9.62, to 0.72 11.0.
TEST(GlassFit, ADecadeOfGrowthIsNeededHoweverWellTheLawFits) {
  const auto exact = [](double from, double to) {
    return exact_times(even_steps(from, (to - from) / 5, 6), 1e-4, power_law);
  };
  for (const GlassLaw law : {GlassLaw::mode_coupling, GlassLaw::vogel_fulcher})
    EXPECT_THAT(
        refusal(exact(0.50, 0.60), law),
        HasSubstr("grow by a factor of only 2.8 from 0.5 to 0.6, and to extrapolate takes 10"));
  EXPECT_THAT(refusal(exact(0.60, 0.716)), HasSubstr("a factor of only 9.6"));
  EXPECT_EQ(refusal(exact(0.60, 0.72)), "");
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
    return fit_glass_law(times(nine_densities, 0.05, draw, y(law)), law);
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
  for (const GlassLaw law : {GlassLaw::mode_coupling, GlassLaw::vogel_fulcher}) {
    const auto points = exact_times(
        nine_densities, 1e-4, [law](double phi) { return glass_law(law, 1.5, 1.8, 0.81, phi); });
    const GlassFit fit = fit_glass_law(points, law);
    ASSERT_EQ(fit.verdict, GlassVerdict::found) << fit.reason;
    EXPECT_NEAR(fit.window.density, 0.81, 1e-8);
    EXPECT_NEAR(fit.window.strength, 1.8, 1e-6);
    EXPECT_NEAR(fit.window.log_prefactor, 1.5, 1e-6);
    EXPECT_EQ(fit.window.densities, 9u);
    EXPECT_EQ(fit.windows.size(), 15u);
    EXPECT_LT(fit.window.low, 0.81);
    EXPECT_GT(fit.window.high, 0.81);
    EXPECT_LT(fit.window.error(), 1e-4);
    EXPECT_NEAR(std::sqrt(fit.window.covariance(2, 2)) / fit.window.error(), 1, 0.01);
    // One-sided limits of 95 % are 1.645 standard errors away.
    EXPECT_NEAR((0.81 - fit.window.least) / fit.window.error(), 1.645, 0.01);
    EXPECT_NEAR((fit.window.strength_most - 1.8) / fit.window.strength_error(), 1.645, 0.02);
  }
  EXPECT_NEAR(glass_law(GlassLaw::mode_coupling, 1.5, 2.4, 0.79, 0.7), power_law(0.7), 1e-12);
  EXPECT_NEAR(glass_law(GlassLaw::vogel_fulcher, -1, 0.42, 0.82, 0.7), vogel_fulcher_law(0.7),
              1e-12);
}

// Two seeds ±d apart in ln τ with errors e, at nine densities: S² = 2 d²/e² per degree of freedom.
TEST(GlassFit, SeedsThatScatterMoreThanTheirErrorsMakeThemLarger) {
  std::vector<GlassPoint> points;
  for (const double phi : nine_densities)
    for (const double sign : {-1.0, 1.0}) {
      const double time = std::exp(power_law(phi) + sign * 0.03);
      points.push_back({phi, time, 0.01 * time});
    }
  const GlassFit fit = fit_glass_law(points, GlassLaw::mode_coupling);
  EXPECT_NEAR(fit.scatter, std::sqrt(2) * 3, 1e-6);
  EXPECT_EQ(fit.window.densities, 9u);
  EXPECT_NEAR(fit.window.density, 0.79, 1e-6);
  for (GlassPoint& p : points) p.error *= std::sqrt(2) * 3;
  EXPECT_NEAR(fit_glass_law(points, GlassLaw::mode_coupling).window.error(), fit.window.error(),
              1e-6 * fit.window.error());
}

TEST(GlassFit, DataThatDoNotSupportAFitAreRefusedWithTheReason) {
  Stream draw(1, Purpose::tests);
  const auto reason = [](const std::vector<GlassPoint>& points) {
    const GlassFit fit = fit_glass_law(points, GlassLaw::mode_coupling);
    EXPECT_EQ(fit.verdict, GlassVerdict::refused);
    return fit.reason;
  };
  EXPECT_THAT(reason({}), HasSubstr("0 densities in equilibrium"));
  EXPECT_THAT(reason(times(even_steps(0.6, 0.02, 4), 0.05, draw, power_law)),
              HasSubstr("4 densities"));
  // Five runs, but only two densities.
  EXPECT_THAT(reason(times({0.6, 0.6, 0.6, 0.7, 0.7}, 0.05, draw, power_law)),
              HasSubstr("2 densities"));
  EXPECT_THAT(
      reason(times(even_steps(0.6, 0.02, 6), 1e-3, draw, [](double phi) { return -10 * phi; })),
      HasSubstr("grow by a factor of only 0.37"));
  EXPECT_THAT(reason(times(even_steps(0.6, 0.02, 6), 1e-3, draw,
                           [](double phi) { return 40 * phi + 2 * std::sin(100 * phi); })),
              HasSubstr("in no window"));
  // They diverge at the highest density itself, but for 5e-7.
  EXPECT_THAT(reason(times(even_steps(0.62, 0.02, 5), 0.3, draw,
                           [](double phi) { return -2.4 * std::log(0.7000005 - phi); })),
              HasSubstr("not distinct"));
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
