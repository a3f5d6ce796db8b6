#include "workflow/analyze/glass_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "core/io/number_text.h"
#include "core/special_values.h"
#include "tests/support/glass_runs.h"
#include "workflow/analyze/glass_tables.h"

namespace vitrel {
namespace {

using testing::HasSubstr;

TEST(GlassTables, SayWhichRunsWereFitted) {
  const GlassStudy study = studied_sweep();
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
  EXPECT_EQ(fits.rows(), 4u);
  EXPECT_EQ(fits.find("phi_c")->value[2],
            fit_of(study, GlassKind::rotation, GlassLaw::mode_coupling).window.density);
  EXPECT_EQ(fits.find("phi_c")->error[2],
            fit_of(study, GlassKind::rotation, GlassLaw::mode_coupling).window.error());
  const Table refused = glass_tables(study_glass({study.runs.front()}))[1];
  EXPECT_EQ(refused.find("verdict")->value.back(), 2);
  EXPECT_TRUE(std::isnan(refused.find("phi_c")->value.back()));
  EXPECT_TRUE(std::isnan(refused.find("window_low")->value.back()));
}

TEST(GlassReport, NotesAndTextSayWhy) {
  const GlassStudy study = studied_sweep();
  std::string notes;
  for (const auto& [name, text] : glass_notes(study)) notes += text + "\n";
  EXPECT_THAT(notes,
              HasSubstr("job_10 (density 0.78, seed 2): rotation stays out of the fits, not enough "
                        "time: tau_2: still 1 at the longest time"));
  const std::string text = glass_text(study);
  EXPECT_THAT(
      text,
      HasSubstr("do not relax within the times measured (beyond what order explains) at 0.76, "
                "0.78."));
  EXPECT_THAT(text, testing::Not(HasSubstr("Nematic order, not glass")));
  const GlassFit& fit = fit_of(study, GlassKind::rotation, GlassLaw::mode_coupling);
  EXPECT_THAT(text, HasSubstr("rotation, tau_2, power law: phi_c = " +
                              with_error(fit.window.density, fit.window.error())));
  const std::string nematic = glass_text(study_glass({judge_glass_run(run_with(0.7, 5, 20, 0.8))}));
  EXPECT_THAT(nematic, HasSubstr("Nematic order, not glass, keeps orientations at 0.7:"));
  EXPECT_THAT(nematic, HasSubstr("translation, tau_alpha: no phi_c: 1 densities in equilibrium"));
}

/// A study of places only, in which 1/D grows as τ^power.
GlassStudy study_of_places(double power, double highest) {
  std::vector<GlassRun> runs;
  for (int k = 0; k <= 8; ++k) {
    const double phi = 0.60 + (highest - 0.60) * k / 8;
    const double tau = std::pow(0.80 - phi, -2.5);
    GlassRunData data = run_with(phi, tau, 20, 0.05, 1e6);
    data.rotors = 0;
    data.diffusion = {std::pow(tau, -power), 0.01 * std::pow(tau, -power), 1, 2, ""};
    runs.push_back(judge_glass_run(data));
  }
  return study_glass(std::move(runs));
}

std::vector<std::string> lines_about(const std::string& what, const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.find(what) != std::string::npos) lines.push_back(line);
  return lines;
}

// (0.2/0.16)^2.5 = 1.7: of neither τ_α nor 1/D, by neither law, is there a density to state.
TEST(GlassReport, TimesThatHardlyGrowGiveOneSentence) {
  const std::string text = glass_text(study_of_places(1.5, 0.64));
  EXPECT_THAT(text, testing::Not(HasSubstr("1/D")));
  EXPECT_THAT(lines_about("phi_c", text),
              testing::ElementsAre("translation, tau_alpha: no phi_c: the times grow by a factor "
                                   "of only 1.7 from 0.6 to 0.64, and to extrapolate takes 10 or "
                                   "more"));
}

// 1/D = τ^1.2 diverges at the same density: it confirms φ_c, and has no number of its own.
TEST(GlassReport, DiffusionIsMentionedAsAgreeing) {
  const GlassStudy study = study_of_places(1.2, 0.76);
  const std::vector<std::string> lines = lines_about("phi_c", glass_text(study));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines[0], testing::StartsWith("translation, tau_alpha, power law: phi_c = 0.79998"));
  EXPECT_THAT(lines[0], testing::EndsWith("; 1/D agrees"));
  EXPECT_EQ(glass_summary(study)["fits"][0]["diffusion"], "agrees");
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

TEST(GlassTables, GiveTheSameStudyAgain) {
  const GlassStudy study = studied_sweep();
  std::vector<GlassRun> runs;
  for (const GlassRun& run : study.runs) runs.push_back(*stored_glass_run(run.name, stored(run)));
  const GlassStudy again = study_glass(runs);
  EXPECT_EQ(glass_text(again), glass_text(study));
  EXPECT_EQ(glass_notes(again), glass_notes(study));
  EXPECT_FALSE(stored_glass_run("x", {}));
}

// Older versions judged a run in the plane by F_s itself, but stored the time relative to the cage too.
TEST(GlassTables, TimesRelativeToTheCageOfOlderVersionsAreUsed) {
  Results results = stored(judge_glass_run(run_with(0.6, 5, 20, 0.05)));
  const auto add = [&](double tau) {
    results.tables.push_back({"relaxation_times",
                              "",
                              {{"kind", "1", {0, 1, 4}, {}},
                               {"tau", "time", {5, 20, tau}, {0.1, 1, 0.2}},
                               {"most", "time", {unknown, unknown, unknown}, {}}}});
  };
  add(7);
  const GlassRun run = *stored_glass_run("job", results);
  EXPECT_TRUE(run.relative_to_cage);
  EXPECT_EQ(run.translation.value, 7);
  EXPECT_EQ(run.translation.error, 0.2);
  EXPECT_TRUE(equilibrated(run.equilibration));
  results.tables.pop_back();
  add(4000);  // of 10,000
  EXPECT_FALSE(equilibrated(stored_glass_run("job", results)->equilibration));
}

TEST(GlassTables, ResultsOfAnotherVersionAreRefused) {
  Results results = stored(judge_glass_run(run_with(0.6, 5, 20, 0.05)));
  std::erase_if(results.tables.back().columns,
                [](const Column& column) { return column.name == "verdict_translation"; });
  EXPECT_THROW(stored_glass_run("job", results), FileError);
}

TEST(GlassReport, DoesNotCallOrderWhatOrderDoesNotExplain) {
  GlassRunData data = run_with(0.7, 5, 20, 0.8);
  for (double& value : data.orientation.value) value = 0.64 + 0.036 + 0.9 * (value - 0.64);
  EXPECT_THAT(glass_text(study_glass({judge_glass_run(data)})),
              testing::Not(HasSubstr("Nematic order, not glass")));
}

TEST(GlassReport, RemarksAreTold) {
  const GlassStudy study =
      study_glass({judge_glass_run(run_with(0.6, 5, 20, 0.05))}, "species[0].aspect_ratio");
  EXPECT_THAT(glass_text(study), HasSubstr("differ in species[0].aspect_ratio"));
  EXPECT_THAT(glass_notes(study).back().second, HasSubstr("differ in species[0].aspect_ratio"));
}

}  // namespace
}  // namespace vitrel
