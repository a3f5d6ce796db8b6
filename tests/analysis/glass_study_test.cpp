#include "analysis/glass/glass_study.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/support/glass_runs.h"

namespace vitrel {
namespace {

using testing::HasSubstr;
using enum EquilibrationVerdict;

TEST(GlassRun, InTheIsotropicLiquidOrientationsRelax) {
  const GlassRun run = judge_glass_run(run_with(0.6, 5, 20, 0.05));
  EXPECT_EQ(run.orientation, OrientationKind::relaxes);
  EXPECT_EQ(run.plateau, 0);
  EXPECT_NEAR(run.translation.value, 5, 0.002 * 5);
  EXPECT_NEAR(run.rotation.value, 20, 0.002 * 20);
  EXPECT_EQ(run.equilibration.verdict, equilibrated);
}

// S = 0.8 ± 0.01/√512: the plateau is within 0.001 of that of the curve, which moves τ by 0.001·e/0.36 < 1 %.
TEST(GlassRun, InTheNematicOrderIsNotTakenForGlass) {
  const GlassRunData data = run_with(0.7, 5, 20, 0.8);
  EXPECT_TRUE(std::isnan(relaxation_time(data.orientation).value));
  const GlassRun run = judge_glass_run(data);
  EXPECT_EQ(run.orientation, OrientationKind::ordered);
  EXPECT_NEAR(run.plateau, 0.64, 0.001);
  EXPECT_NEAR(run.rotation.value, 20, 0.2);
  EXPECT_EQ(run.equilibration.verdict, equilibrated);
}

// A tenth of what order leaves free stays for ever: the connected part falls below 1/e, but does not vanish.
TEST(GlassRun, NematicOrderMustExplainTheWholePlateau) {
  GlassRunData data = run_with(0.7, 5, 20, 0.8);
  for (double& value : data.orientation.value) value = 0.64 + 0.036 + 0.9 * (value - 0.64);
  const GlassRun run = judge_glass_run(data);
  EXPECT_FALSE(std::isnan(run.rotation.value));
  EXPECT_EQ(run.orientation, OrientationKind::lasting);
}

TEST(GlassRun, WhatOrderDoesNotExplainLasts) {
  for (const double order : {0.05, 0.8}) {
    const GlassRun run = judge_glass_run(run_with(0.75, 5, 1e6, order));
    EXPECT_EQ(run.orientation, OrientationKind::lasting) << order;
    EXPECT_EQ(run.equilibration.verdict, too_short) << order;
    EXPECT_THAT(run.equilibration.reason, HasSubstr("tau_2: still"));
  }
}

// S = 0.6 of 20 rotors is less than three times √(π/80) = 0.198; of 25 it is more than 3·0.177.
TEST(GlassRun, OrderOfAFewRotorsMayBeChance) {
  GlassRunData data = run_with(0.6, 5, 20, 0.6);
  data.orientation = decay(20, data.duration);
  data.nematic_order = std::vector<double>(64, 0.59);
  data.rotors = 20;
  EXPECT_EQ(judge_glass_run(data).orientation, OrientationKind::relaxes);
  data.rotors = 25;
  EXPECT_EQ(judge_glass_run(data).orientation, OrientationKind::ordered);
}

TEST(GlassRun, DriftOfTheOrderIsAgeing) {
  GlassRunData data = run_with(0.7, 5, 20, 0.8);
  for (std::size_t k = 0; k < data.nematic_order.size(); ++k)
    data.nematic_order[k] += 0.02 * static_cast<double>(k) / 512;
  const GlassRun run = judge_glass_run(data);
  EXPECT_EQ(run.equilibration.verdict, ageing);
  EXPECT_THAT(run.equilibration.reason, HasSubstr("the nematic order drifts"));
  EXPECT_EQ(run.translation_equilibration.verdict, equilibrated);
}

/// The verdicts of a run of 1000 after reconciliation.
GlassRun reconciled(EquilibrationVerdict all, EquilibrationVerdict translation, double tau) {
  GlassRun run{};
  run.duration = 1000;
  run.translation = {tau, 0.1 * tau, unknown, unknown, ""};
  run.equilibration = {all, "of all", 2};
  run.translation_equilibration = {translation, "of places", 6};
  reconcile_verdicts(run);
  return run;
}

// A run of docs/glass.md was called ageing in its places and in equilibrium altogether.
TEST(GlassRun, EquilibriumOfEverythingIsThatOfTranslation) {
  EXPECT_EQ(reconciled(equilibrated, ageing, 10).translation_equilibration.verdict, equilibrated);
  EXPECT_EQ(reconciled(too_short, ageing, 10).translation_equilibration.verdict, ageing);
  EXPECT_EQ(reconciled(ageing, equilibrated, 10).translation_equilibration.verdict, equilibrated);
}

TEST(GlassRun, NoRunShorterThanThreeRelaxationTimesIsLongEnough) {
  EXPECT_EQ(reconciled(equilibrated, equilibrated, 333).equilibration.verdict, equilibrated);
  const GlassRun run = reconciled(equilibrated, equilibrated, 334);
  EXPECT_EQ(run.equilibration.verdict, too_short);
  EXPECT_EQ(run.translation_equilibration.verdict, too_short);
  EXPECT_EQ(run.equilibration.reason, "the run lasts less than 3 times tau_alpha");
  EXPECT_EQ(reconciled(ageing, ageing, unknown).equilibration.verdict, ageing);
}

TEST(GlassRun, DisksHaveNoOrientation) {
  GlassRunData data = run_with(0.7, 5, 20, 0.05);
  data.rotors = 0;
  data.orientation = {};
  data.nematic_order.clear();
  const GlassRun run = judge_glass_run(data);
  EXPECT_EQ(run.orientation, OrientationKind::round);
  EXPECT_EQ(run.equilibration.verdict, equilibrated);
  EXPECT_EQ(study_glass({run}).laws.size(), 2u);  // of translation
}

TEST(GlassStudy, FindsBothTransitionsFromTheRunsInEquilibrium) {
  const GlassStudy study = studied_sweep();
  struct Transition {
    GlassKind kind;
    double density, highest;
  };
  // At 0.76 and 0.78 orientations did not equilibrate, but places did.
  for (const auto& [kind, density, highest] : {Transition{GlassKind::rotation, 0.76, 0.74},
                                               Transition{GlassKind::translation, 0.80, 0.78}}) {
    const GlassFit& fit = fit_of(study, kind, GlassLaw::mode_coupling);
    ASSERT_EQ(fit.verdict, GlassVerdict::found) << fit.reason;
    EXPECT_NEAR(fit.window.density, density, 2 * fit.window.error());
    double high = 0;
    for (const GlassWindow& window : fit.windows) high = std::max(high, window.highest);
    EXPECT_NEAR(high, highest, 1e-9);
  }
  EXPECT_LT(fit_of(study, GlassKind::rotation, GlassLaw::mode_coupling).window.error(), 0.005);
}

// A power law with φ_c = 0.72 that holds up to 0.70, and slower growth beyond.
TEST(GlassStudy, WhatRelaxesBeyondThePowerLawRefutesIt) {
  std::vector<GlassRun> runs;
  for (int k = 0; k <= 11; ++k) {
    const double phi = 0.60 + 0.0125 * k;
    const double tau =
        phi < 0.7 ? std::pow(0.72 - phi, -2) : std::pow(0.0325, -2) * (1 + phi - 0.6875);
    runs.push_back(judge_glass_run(run_with(phi, tau, 20, 0.05, 1e6)));
  }
  const GlassStudy study = study_glass(std::move(runs));
  const GlassFit& fit = fit_of(study, GlassKind::translation, GlassLaw::mode_coupling);
  EXPECT_EQ(fit.verdict, GlassVerdict::refused);
  EXPECT_THAT(fit.reason, HasSubstr("times at 0.725 are finite, beyond the phi_c = 0.72"));
}

/// τ_α diverges at 0.80, and 1/D at another density.
DiffusionVerdict verdict_of_diffusion(double density, double strength) {
  std::vector<GlassRun> runs;
  for (int k = 0; k <= 8; ++k) {
    const double phi = 0.60 + 0.02 * k;
    GlassRunData data = run_with(phi, std::pow(0.80 - phi, -2.5), 20, 0.05, 1e6);
    const double d = std::pow(density - phi, strength);
    data.diffusion = {d, 0.002 * d, 1, 2, ""};
    runs.push_back(judge_glass_run(data));
  }
  return study_glass(std::move(runs)).laws.front().diffusion;
}

// Without scatter the errors of φ_c are below 0.003. (0.9 − φ)^−1 grows by 2.1 only and says nothing.
TEST(GlassStudy, DiffusionConfirmsTheDensityOrDoesNot) {
  EXPECT_EQ(verdict_of_diffusion(0.80, 2), DiffusionVerdict::agrees);
  EXPECT_EQ(verdict_of_diffusion(0.84, 3), DiffusionVerdict::disagrees);
  EXPECT_EQ(verdict_of_diffusion(0.90, 1), DiffusionVerdict::untested);
}

TEST(GlassStudy, TimesRelativeToTheCageAreNotMixedWithOthers) {
  GlassRun relative = judge_glass_run(run_with(0.6, 5, 20, 0.05));
  relative.relative_to_cage = true;
  EXPECT_FALSE(study_glass({relative}).laws.empty());
  EXPECT_THAT(study_glass({relative}).remarks.back(), HasSubstr("relative to the cage"));
  const GlassStudy mixed = study_glass({relative, judge_glass_run(run_with(0.62, 5, 20, 0.05))});
  EXPECT_TRUE(mixed.laws.empty());
}

TEST(GlassStudy, NoLawIsFittedToDifferentSystems) {
  const GlassStudy study =
      study_glass({judge_glass_run(run_with(0.6, 5, 20, 0.05))}, "species[0].aspect_ratio");
  EXPECT_TRUE(study.laws.empty());
  EXPECT_THAT(study.remarks.back(), HasSubstr("differ in species[0].aspect_ratio"));
}

}  // namespace
}  // namespace vitrel
