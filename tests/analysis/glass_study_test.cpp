#include "analysis/glass/glass_study.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/random/stream.h"
#include "workflow/report/page_parts.h"

namespace vitrel {
namespace {

using testing::HasSubstr;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// P + (1 − P) exp(−t/τ) at 20 times a decade, up to half of the duration, with the error that makes
/// one of 1 % for τ: 0.01 (1 − P)/e.
Decay decay(double tau, double duration, double plateau = 0) {
  Decay result;
  for (double t = 0.1; t <= duration / 2; t *= std::pow(10, 0.05)) {
    result.time.push_back(t);
    result.value.push_back(plateau + (1 - plateau) * std::exp(-t / tau));
    result.error.push_back(0.01 * (1 - plateau) / std::exp(1));
  }
  return result;
}

std::vector<double> noise_about(double mean, double width, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  std::vector<double> series(512);
  for (double& value : series) value = mean + width * draw.normal();
  return series;
}

/// 500 rotors with relaxation times tau_t and tau_r, and nematic order S.
GlassRunData run_with(double packing_fraction, double tau_t, double tau_r, double order,
                      double duration = 1e4) {
  GlassRunData data;
  data.name = "job";
  data.packing_fraction = packing_fraction;
  data.seed = 1;
  data.rotors = 500;
  data.duration = duration;
  data.scattering = decay(tau_t, duration);
  data.orientation = decay(tau_r, duration, order > 0.5 ? order * order : 0);
  data.nematic_order = noise_about(order, 0.01, 7);
  data.series = {{"the hexatic order", noise_about(0.3, 0.01, 8)}};
  data.diffusion = {1 / tau_t, 0.01 / tau_t, 1, 2, ""};
  data.rotational_diffusion = {unknown, unknown, unknown, unknown, "not reached"};
  return data;
}

TEST(GlassRun, InTheIsotropicLiquidOrientationsRelax) {
  const GlassRun run = judge_glass_run(run_with(0.6, 5, 20, 0.05));
  EXPECT_EQ(run.orientation, OrientationKind::relaxes);
  EXPECT_EQ(run.plateau, 0);
  EXPECT_NEAR(run.translation.value, 5, 0.002 * 5);
  EXPECT_NEAR(run.rotation.value, 20, 0.002 * 20);
  EXPECT_EQ(run.equilibration.verdict, EquilibrationVerdict::equilibrated);
}

// S = 0.8 ± 0.01/√512: the plateau is within 0.001 of that of the curve, which moves τ by 0.001·e/0.36 < 1 %.
TEST(GlassRun, InTheNematicOrderIsNotTakenForGlass) {
  const GlassRunData data = run_with(0.7, 5, 20, 0.8);
  EXPECT_TRUE(std::isnan(relaxation_time(data.orientation).value));
  const GlassRun run = judge_glass_run(data);
  EXPECT_EQ(run.orientation, OrientationKind::ordered);
  EXPECT_NEAR(run.plateau, 0.64, 0.001);
  EXPECT_NEAR(run.rotation.value, 20, 0.2);
  EXPECT_EQ(run.equilibration.verdict, EquilibrationVerdict::equilibrated);
}

// A tenth of what order leaves free stays for ever: the connected part falls below 1/e, but does not vanish.
TEST(GlassRun, NematicOrderMustExplainTheWholePlateau) {
  GlassRunData data = run_with(0.7, 5, 20, 0.8);
  for (double& value : data.orientation.value) value = 0.64 + 0.036 + 0.9 * (value - 0.64);
  const GlassRun run = judge_glass_run(data);
  EXPECT_FALSE(std::isnan(run.rotation.value));
  EXPECT_EQ(run.orientation, OrientationKind::lasting);
  EXPECT_THAT(glass_text(study_glass({run})), testing::Not(HasSubstr("Nematic order, not glass")));
}

TEST(GlassRun, WhatOrderDoesNotExplainLasts) {
  const GlassRun isotropic = judge_glass_run(run_with(0.75, 5, 1e6, 0.05));
  EXPECT_EQ(isotropic.orientation, OrientationKind::lasting);
  EXPECT_EQ(isotropic.equilibration.verdict, EquilibrationVerdict::too_short);
  const GlassRun nematic = judge_glass_run(run_with(0.75, 5, 1e6, 0.8));
  EXPECT_EQ(nematic.orientation, OrientationKind::lasting);
  EXPECT_EQ(nematic.equilibration.verdict, EquilibrationVerdict::too_short);
  EXPECT_THAT(nematic.equilibration.reason, HasSubstr("tau_2: still"));
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
  EXPECT_EQ(run.equilibration.verdict, EquilibrationVerdict::ageing);
  EXPECT_THAT(run.equilibration.reason, HasSubstr("the nematic order drifts"));
  EXPECT_EQ(run.translation_equilibration.verdict, EquilibrationVerdict::equilibrated);
}

TEST(GlassRun, DisksHaveNoOrientation) {
  GlassRunData data = run_with(0.7, 5, 20, 0.05);
  data.rotors = 0;
  data.orientation = {};
  data.nematic_order.clear();
  const GlassRun run = judge_glass_run(data);
  EXPECT_EQ(run.orientation, OrientationKind::round);
  EXPECT_EQ(run.equilibration.verdict, EquilibrationVerdict::equilibrated);
  EXPECT_EQ(study_glass({run}).laws.size(), 4u);  // two laws of translation and of diffusion
}

/// Two seeds at eleven densities: τ_α diverges at 0.80, τ_2 at 0.76; runs last 2·10⁵.
GlassStudy sweep() {
  std::vector<GlassRun> runs;
  Stream draw(3, Purpose::tests);
  for (int k = 0; k <= 10; ++k)
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const double phi = 0.58 + 0.02 * k;
      const double tau_t = 0.5 * std::pow(0.80 - phi, -2.5) * std::exp(0.01 * draw.normal());
      const double tau_r =
          phi < 0.76 ? std::pow(0.76 - phi, -2) * std::exp(0.01 * draw.normal()) : 1e9;
      GlassRunData data = run_with(phi, tau_t, tau_r, 0.05, 2e5);
      data.seed = seed;
      data.name = "job_" + std::to_string(k);
      runs.push_back(judge_glass_run(data));
    }
  return study_glass(std::move(runs));
}

const GlassFit& fit_of(const GlassStudy& study, GlassKind kind, GlassLaw law) {
  for (const StudiedLaw& studied : study.laws)
    if (studied.kind == kind && studied.law == law) return studied.fit;
  throw std::logic_error("no such law");
}

TEST(GlassStudy, FindsBothTransitionsFromTheRunsInEquilibrium) {
  const GlassStudy study = sweep();
  const GlassFit& turning = fit_of(study, GlassKind::rotation, GlassLaw::mode_coupling);
  const GlassFit& moving = fit_of(study, GlassKind::translation, GlassLaw::mode_coupling);
  ASSERT_EQ(turning.verdict, GlassVerdict::found) << turning.reason;
  ASSERT_EQ(moving.verdict, GlassVerdict::found) << moving.reason;
  EXPECT_NEAR(turning.density, 0.76, 2 * turning.error);
  EXPECT_NEAR(moving.density, 0.80, 2 * moving.error);
  EXPECT_LT(turning.error, 0.005);
  // At 0.76 and 0.78 orientations did not equilibrate, but places did.
  const auto highest = [](const GlassFit& fit) {
    double high = 0;
    for (const GlassWindow& window : fit.windows) high = std::max(high, window.highest);
    return high;
  };
  EXPECT_NEAR(highest(turning), 0.74, 1e-9);
  EXPECT_NEAR(highest(moving), 0.78, 1e-9);
}

TEST(GlassStudy, TablesSayWhichRunsWereFitted) {
  const GlassStudy study = sweep();
  const std::vector<Table> tables = glass_tables(study);
  ASSERT_EQ(tables.size(), 3u);
  for (const Table& table : tables)
    for (const Column& column : table.columns) {
      EXPECT_EQ(column.value.size(), table.rows()) << table.name << ' ' << column.name;
      EXPECT_THAT(column.error.size(), testing::AnyOf(0, table.rows())) << column.name;
    }
  const Table& relaxation = tables[0];
  EXPECT_EQ(relaxation.name, "relaxation");
  EXPECT_EQ(relaxation.rows(), 22u);
  for (std::size_t k = 0; k < relaxation.rows(); ++k) {
    const GlassRun& run = study.runs[k];
    const bool in_time = relaxation.find("packing_fraction")->value[k] < 0.75;
    EXPECT_EQ(relaxation.find("verdict")->value[k], in_time ? 0 : 2);
    EXPECT_EQ(relaxation.find("verdict_translation")->value[k], 0);
    EXPECT_GT(relaxation.find("tests")->value[k], in_time ? 0 : -1);
    EXPECT_EQ(relaxation.find("tau_translation")->value[k], run.translation.value);
    EXPECT_EQ(relaxation.find("tau_translation")->error[k], run.translation.error);
    EXPECT_EQ(relaxation.find("plateau")->value[k], 0);  // none is nematic
    EXPECT_EQ(relaxation.find("orientation")->value[k], in_time ? 1 : 3);
  }
  const Table& fits = tables[1];
  EXPECT_EQ(fits.name, "glass_fit");
  EXPECT_EQ(fits.rows(), 8u);
  EXPECT_EQ(fits.find("phi_c")->value[2],
            fit_of(study, GlassKind::rotation, GlassLaw::mode_coupling).density);
  EXPECT_EQ(fits.find("phi_c")->error[2],
            fit_of(study, GlassKind::rotation, GlassLaw::mode_coupling).error);
  EXPECT_EQ(fits.find("verdict")->value.back(), 2);
  EXPECT_TRUE(std::isnan(fits.find("phi_c")->value.back()));
  EXPECT_TRUE(std::isnan(fits.find("window_low")->value.back()));
}

TEST(GlassStudy, NotesAndTextSayWhy) {
  const GlassStudy study = sweep();
  std::string notes;
  for (const auto& [name, text] : glass_notes(study)) notes += text + "\n";
  EXPECT_THAT(notes,
              HasSubstr("job_10 (density 0.78, seed 2): rotation stays out of the fits, not enough "
                        "time: tau_2: still 1 at the longest time"));
  EXPECT_THAT(notes,
              HasSubstr("rotational diffusion, 1/D_r: no phi_c: 0 densities in equilibrium"));
  const std::string text = glass_text(study);
  EXPECT_THAT(
      text,
      HasSubstr("do not relax within the times measured (beyond what order explains) at 0.76, "
                "0.78."));
  EXPECT_THAT(text, testing::Not(HasSubstr("Nematic order, not glass")));
  const GlassFit& fit = fit_of(study, GlassKind::rotation, GlassLaw::mode_coupling);
  EXPECT_THAT(
      text, HasSubstr("rotation, tau_2, power law: phi_c = " + with_error(fit.density, fit.error)));
  const std::string nematic = glass_text(study_glass({judge_glass_run(run_with(0.7, 5, 20, 0.8))}));
  EXPECT_THAT(nematic, HasSubstr("Nematic order, not glass, keeps orientations at 0.7:"));
  EXPECT_THAT(nematic, HasSubstr("translation, tau_alpha: no phi_c: 1 densities in equilibrium"));
}

/// The results of a run as the analysis stores them.
Results stored(const GlassRun& run) {
  const auto column = [](const char* name, double value) {
    return Column{name, "1", {value}, {0.01 * value}};
  };
  Results results;
  results.tables = {
      {"summary",
       "",
       {column("rotors", static_cast<double>(run.rotors)), column("diffusion", run.diffusion.value),
        column("diffusion_from", 1), column("diffusion_to", 2),
        column("rotational_diffusion", run.rotational_diffusion.value),
        column("rotational_diffusion_from", 1), column("rotational_diffusion_to", 2)}}};
  store_glass_run(run, results);
  return results;
}

TEST(GlassStudy, IsTheSameFromStoredResults) {
  const GlassStudy study = sweep();
  std::vector<GlassRun> runs;
  for (const GlassRun& run : study.runs) runs.push_back(*stored_glass_run(run.name, stored(run)));
  const GlassStudy again = study_glass(runs);
  EXPECT_EQ(glass_text(again), glass_text(study));
  EXPECT_EQ(glass_notes(again), glass_notes(study));
  EXPECT_FALSE(stored_glass_run("x", {}));
}

TEST(GlassStudy, ResultsOfAnotherVersionAreRefused) {
  Results results = stored(judge_glass_run(run_with(0.6, 5, 20, 0.05)));
  std::erase_if(results.tables.back().columns,
                [](const Column& column) { return column.name == "verdict_translation"; });
  EXPECT_THROW(stored_glass_run("job", results), FileError);
}

// A power law with φ_c = 0.72 that holds up to 0.70, and slower growth beyond: a crossover.
TEST(GlassStudy, WhatRelaxesBeyondThePowerLawIsSaid) {
  std::vector<GlassRun> runs;
  for (int k = 0; k <= 11; ++k) {
    const double phi = 0.60 + 0.0125 * k;
    const double tau =
        phi < 0.7 ? std::pow(0.72 - phi, -2) : std::pow(0.0325, -2) * (1 + phi - 0.6875);
    runs.push_back(judge_glass_run(run_with(phi, tau, 20, 0.05, 1e6)));
  }
  const GlassStudy study = study_glass(std::move(runs));
  const GlassFit& fit = fit_of(study, GlassKind::translation, GlassLaw::mode_coupling);
  ASSERT_EQ(fit.verdict, GlassVerdict::found) << fit.reason;
  EXPECT_NEAR(fit.density, 0.72, 2 * fit.error);
  EXPECT_THAT(glass_text(study),
              HasSubstr("where the system is still in equilibrium: it marks a crossover"));
}

TEST(GlassStudy, NoLawIsFittedToDifferentSystems) {
  const GlassStudy study =
      study_glass({judge_glass_run(run_with(0.6, 5, 20, 0.05))}, "species[0].aspect_ratio");
  EXPECT_TRUE(study.laws.empty());
  EXPECT_THAT(glass_text(study), HasSubstr("differ in species[0].aspect_ratio"));
  EXPECT_THAT(glass_notes(study).back().second, HasSubstr("differ in species[0].aspect_ratio"));
}

}  // namespace
}  // namespace vitrel
