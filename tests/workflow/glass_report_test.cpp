#include "workflow/analyze/glass_report.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/io/number_text.h"
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
  EXPECT_EQ(fits.rows(), 8u);
  EXPECT_EQ(fits.find("phi_c")->value[2],
            fit_of(study, GlassKind::rotation, GlassLaw::mode_coupling).density);
  EXPECT_EQ(fits.find("phi_c")->error[2],
            fit_of(study, GlassKind::rotation, GlassLaw::mode_coupling).error);
  EXPECT_EQ(fits.find("verdict")->value.back(), 2);
  EXPECT_TRUE(std::isnan(fits.find("phi_c")->value.back()));
  EXPECT_TRUE(std::isnan(fits.find("window_low")->value.back()));
}

TEST(GlassReport, NotesAndTextSayWhy) {
  const GlassStudy study = studied_sweep();
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

TEST(GlassTables, GiveTheSameStudyAgain) {
  const GlassStudy study = studied_sweep();
  std::vector<GlassRun> runs;
  for (const GlassRun& run : study.runs) runs.push_back(*stored_glass_run(run.name, stored(run)));
  const GlassStudy again = study_glass(runs);
  EXPECT_EQ(glass_text(again), glass_text(study));
  EXPECT_EQ(glass_notes(again), glass_notes(study));
  EXPECT_FALSE(stored_glass_run("x", {}));
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
