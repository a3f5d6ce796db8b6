// Analysis, report and export of saved runs and sweeps from outside: what they take, what they refuse, and
// that no file is lost.

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <span>
#include <sstream>

#include "analysis/observables/observable.h"
#include "analysis/results.h"
#include "analysis/statistics/blocking.h"
#include "tests/app/end_to_end.h"

namespace vitrel {
namespace {

const std::string tiny_system =
    "[system]\nparticles = 20\n[prepare]\nquality_sweeps = 10\n"
    "[dynamics]\nequilibration = 1\nduration = 10\n"
    "[output]\nsamples = { spacing = \"linear\", interval = 0.5 }\n"
    "correlations = { interval = 0.5 }\n";

/// A state and a run of it.
class SavedRun : public testing::Test {
 protected:
  SavedRun() {
    folder.succeed("prepare p.toml -o state.h5 -q");
    folder.succeed("run p.toml --from state.h5 -o run.h5 -q");
  }
  /// A refusal that leaves the file as it was.
  void expect_kept(const std::string& file, const std::string& command,
                   const std::string& complaint) const {
    const std::string before = folder.read(file);
    folder.expect_refusal(command, 2, complaint);
    EXPECT_EQ(folder.read(file), before) << file;
  }

  const Folder folder{"saved_run", tiny_system};
};

// What was chosen to simulate the particles stands in the plan, in the summary, in the file and on the page.
TEST(SavedRuns, StatesAndRunsSayHowTheyWereMade) {
  const Folder folder(
      "model", tiny_system +
                   "[[species]]\naspect_ratio = 2\n"
                   "[[prepare.stage]]\nmethod = \"insert\"\n"
                   "[[prepare.stage]]\nmethod = \"hybrid\"\n"
                   "[[prepare.stage]]\nmethod = \"sample\"\nmoves = \"local\"\nsweeps = 9\n");
  const std::string why = " of ellipses, since some particle is not round";
  const std::string preparation =
      "hybrid: growing ellipses, since semi-axes change with time, and "
      "event chains" +
      why + "; sample: local moves" + why;
  const std::string dynamics = "rotating ellipses, since some particle is not round";
  const auto expect_model = [&](const std::string& command, const std::string& file,
                                const std::string& model) {
    EXPECT_THAT(folder.run(command + " --dry-run -o " + file).output,
                HasSubstr("prepares by  " + preparation + "\n"));
    EXPECT_EQ(folder.summary(command + " -o " + file)["model"], model);
    folder.succeed("report " + file + " -o page.html -q");
    EXPECT_THAT(folder.read("page.html"), HasSubstr(model));
  };
  expect_model("prepare p.toml", "state.h5", preparation);
  expect_model("run p.toml", "run.h5", dynamics + "; prepared by " + preparation);
  EXPECT_EQ(folder.summary("run p.toml --from state.h5 -o from.h5")["model"], dynamics);
}

TEST_F(SavedRun, IsNotOverwrittenByCommandsThatReadIt) {
  fs::create_symlink("run.h5", folder / "link.h5");
  std::map<std::string, std::string> before;
  for (const char* name : {"p.toml", "state.h5", "run.h5"}) before[name] = folder.read(name);
  const char* is_read = "is read, and must not be overwritten; choose another output";
  for (const std::string command : {"analyze", "report"}) {
    for (const char* output : {"run.h5", "./run.h5", "link.h5"})
      folder.expect_refusal(command + " run.h5 -o " + output, 2, is_read);
    folder.expect_refusal(command + " run.h5 --params p.toml -o p.toml", 2, is_read);
  }
  folder.expect_refusal("report state.h5 -o state.h5", 2, is_read);
  folder.expect_refusal("run p.toml --from run.h5 -o run.h5", 2, is_read);
  folder.expect_refusal("run p.toml -o p.toml", 2, is_read);
  folder.expect_refusal("prepare p.toml -o p.toml", 2, "exists already");
  folder.expect_refusal("export run.h5 --to xyz -o run.h5", 2, "exists already");
  for (const auto& [name, bytes] : before) EXPECT_EQ(folder.read(name), bytes) << name;
}

TEST_F(SavedRun, IsAnalysedIntoNothingButResults) {
  folder.write("notes.txt", "mine");
  fs::copy_file(folder / "run.h5", folder / "other.h5");
  fs::copy_file(folder / "run.h5.correlations.h5", folder / "correlations.h5");
  for (const std::string output : {"notes.txt", "other.h5", "state.h5", "correlations.h5"})
    expect_kept(output, "analyze run.h5 -o " + output,
                output + ": exists and holds no results of vitrel analyze");
  folder.expect_refusal("analyze run.h5 -o .", 2, ".: is a folder");
  folder.expect_refusal("analyze run.h5 -o /dev/null", 2, "/dev/null: is a device");
  folder.succeed("analyze run.h5 -q");
  const std::string first = folder.read("run_results/displacements_all.csv");
  folder.succeed("analyze run.h5 -q --set analysis.longest_lag=0.1");
  EXPECT_LT(folder.read("run_results/displacements_all.csv").size(), first.size() / 2);
}

TEST_F(SavedRun, IsReportedIntoNothingButPages) {
  folder.succeed("analyze run.h5 -q");
  for (const std::string output : {"run_results.h5", "p.toml", "state.quality.json"})
    for (const std::string input : {"run.h5", "state.h5"})
      expect_kept(output, "report " + input + " -o " + output,
                  output + ": exists and is not an HTML page");
  folder.write("run.html", "<!DOCTYPE html>\n<p>an earlier one");
  folder.succeed("report run.h5 -q");
  EXPECT_GT(fs::file_size(folder / "run.html"), 10'000u);
}

TEST(SavedRuns, TheSummaryGivesErrorsBesideTheirValues) {
  const Folder folder("summary", tiny_system);
  // Many samples, so that the errors are known.
  folder.succeed("run p.toml -o run.h5 -q --set output.samples.interval=0.02");
  const std::string text = folder.run("analyze run.h5").output;
  const Results results = read_results(folder / "run_results.h5");
  const Column& z = *results.find("summary")->find("compressibility_factor");
  const std::size_t line = text.find("compressibility_factor     ");
  ASSERT_NE(line, std::string::npos) << text;
  std::istringstream words(text.substr(line));
  std::string name, sign;
  double value = 0, error = 0;
  ASSERT_TRUE(words >> name >> value >> sign >> error) << text;
  EXPECT_EQ(sign, "±");
  // Two digits of the error.
  EXPECT_NEAR(error, z.error[0], 0.051 * z.error[0]);
  EXPECT_NEAR(value, z.value[0], 0.051 * z.error[0]);
  EXPECT_THAT(text, AllOf(Not(HasSubstr("_error")), Not(HasSubstr("nan"))));
}

TEST(SavedRuns, AnEndingSlashNamesAFolderToo) {
  const Folder folder("slash", tiny_system);
  folder.succeed("run p.toml -o run.h5 -q --set system.dimension=3");
  folder.succeed("export run.h5 --to vtp -o bodies/ -q");
  EXPECT_TRUE(fs::is_directory(folder / "bodies"));
}

TEST_F(SavedRun, OfTablesThatAreGoneNothingStays) {
  folder.succeed("analyze run.h5 -q");
  folder.write("run_results/notes.csv", "mine");
  ASSERT_TRUE(fs::exists(folder / "run_results/on_the_fly_all.csv"));
  fs::remove(folder / "run.h5.correlations.h5");
  folder.succeed("analyze run.h5 -q");
  EXPECT_FALSE(fs::exists(folder / "run_results/on_the_fly_all.csv"));
  EXPECT_TRUE(fs::exists(folder / "run_results/notes.csv"));
  for (const Table& table : read_results(folder / "run_results.h5").tables)
    EXPECT_TRUE(fs::exists(folder / ("run_results/" + table.name + ".csv"))) << table.name;
}

// The input is no run, so that no message about the output can come after the work.
TEST(SavedRuns, TheOutputIsLookedAtFirst) {
  const Folder folder("missing_folder", tiny_system);
  folder.write("no_run.h5", "");
  for (const std::string command : {"prepare p.toml", "run p.toml", "run p.toml --from no_run.h5",
                                    "analyze no_run.h5", "export no_run.h5 --to gsd"})
    folder.expect_refusal(
        command + " -o absent/output", 3,
        "absent/output: cannot be written: there is no folder " + (folder / "absent").string());
  folder.expect_refusal("analyze no_run.h5 -o p.toml", 2, "p.toml: exists and holds no");
  folder.expect_refusal("analyze absent.h5", 3, "absent.h5: there is no such file");
}

TEST_F(SavedRun, SettingsWithoutEffectAreRefused) {
  for (const std::string command : {"analyze", "report"}) {
    folder.expect_refusal(command + " run.h5 --set dynamics.duration=5", 2,
                          "--set dynamics.duration=5: has no effect on an existing run; only "
                          "analysis.… and import.… can be set");
    folder.expect_refusal(command + " run.h5 --set analysis.longest_leg=1", 2,
                          "key 'analysis.longest_leg' is unknown");
  }
  const char* no_analysis = "is a single state, whose page holds no analysis";
  folder.expect_refusal("report state.h5 --params p.toml", 2, no_analysis);
  folder.expect_refusal("report state.h5 --set analysis.longest_lag=0.1", 2, no_analysis);
  EXPECT_FALSE(fs::exists(folder / "state.html"));
}

/// The names of the jobs of a sweep over densities and seeds, in their order.
const std::vector<std::string> in_order = {
    "packing_fraction-0.3_seed-2", "packing_fraction-0.3_seed-10", "packing_fraction-0.4_seed-2",
    "packing_fraction-0.4_seed-10"};

/// Densities and seeds whose order is neither that of the jobs nor that of their names.
const std::string four_jobs = tiny_system +
                              "[sweep.grid]\n\"system.packing_fraction\" = [0.4, 0.3]\n"
                              "\"system.seed\" = [10, 2]\n";

class SavedSweep : public testing::Test {
 protected:
  SavedSweep() { folder_.succeed("sweep p.toml -o sweep -j 2 -q"); }

  const Folder folder_{"saved_sweep", four_jobs};
};

TEST_F(SavedSweep, RunsAreOrderedByDensityThenBySeed) {
  folder_.succeed("analyze sweep -q");
  const Results results = read_results(folder_ / "sweep/results.h5");
  std::vector<std::string> rows;
  for (std::string file; !(file = results.text("row_" + std::to_string(rows.size()))).empty();)
    rows.push_back(fs::path(file).parent_path().filename());
  EXPECT_EQ(rows, in_order);
  const Table& runs = *results.find("runs");
  for (std::size_t k = 0; k < 4; ++k) {
    const Results of_job = read_results(folder_ / ("sweep/" + rows[k] + "/results.h5"));
    EXPECT_EQ(runs.find("collisions")->value[k],
              of_job.find("summary")->find("collisions")->value[0]);
  }
  folder_.succeed("report sweep -q");
  const std::string page = folder_.read("sweep/report.html");
  std::size_t place = 0;
  for (const std::string& row : rows) {
    place = page.find("<td>" + row + "</td>", place);
    EXPECT_NE(place, std::string::npos) << row;
  }
}

// Two values d apart have the 95 % interval ± tan(0.95 π/2) d/2: Student's quantile for one degree of freedom.
TEST_F(SavedSweep, SeedsAreAveraged) {
  folder_.succeed("analyze sweep -q");
  const Results results = read_results(folder_ / "sweep/results.h5");
  const Table& runs = *results.find("runs");
  EXPECT_THAT(runs.find("seed")->value, ElementsAre(2, 10, 2, 10));
  const Table& seeds = *results.find("seeds");
  EXPECT_THAT(seeds.find("system_packing_fraction")->value, ElementsAre(0.3, 0.4));
  EXPECT_THAT(seeds.find("seeds")->value, ElementsAre(2, 2));
  EXPECT_EQ(runs.find("job")->labels, in_order);
  const Column& z = *seeds.find("compressibility_factor");
  EXPECT_EQ(seeds.find("tau_translation")->unit, "time");
  const Column& of_runs = *runs.find(z.name);
  for (std::size_t k = 0; k < 2; ++k) {
    const MeanOfRuns mean = mean_of_runs(std::span(of_runs.value).subspan(2 * k, 2),
                                         std::span(of_runs.error).subspan(2 * k, 2));
    EXPECT_NEAR(z.value[k], mean.mean, 1e-12 * mean.mean);
    EXPECT_LT(z.error[k], seeds.find(z.name + "_interval")->value[k]);
    EXPECT_NEAR(seeds.find(z.name + "_interval")->value[k], mean.half_width(0.95), 1e-9);
    EXPECT_NEAR(seeds.find(z.name + "_scatter")->value[k], mean.scatter, 1e-9);
  }
}

TEST_F(SavedSweep, OtherParametersOfTheAnalysisLeaveTheJobsAlone) {
  folder_.succeed("analyze sweep -q");
  const std::string plain = folder_.read("sweep/results/runs.csv");
  std::map<std::string, std::string> before;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "sweep" / in_order[0])) {
    const std::string file = fs::relative(entry, folder_.path());
    if (entry.is_regular_file()) before[file] = folder_.read(file);
  }
  folder_.succeed("analyze sweep -q --set analysis.longest_lag=0.2");
  for (const auto& [file, text] : before) EXPECT_EQ(folder_.read(file), text) << file;
  // Diffusion comes from the longest time differences.
  EXPECT_NE(folder_.read("sweep/results/runs.csv"), plain);
  folder_.succeed("analyze sweep -q");
  EXPECT_EQ(folder_.read("sweep/results/runs.csv"), plain);
}

TEST_F(SavedSweep, ItsOwnFilesAreNotOverwritten) {
  for (const std::string file : {"/run.h5", "/results.h5"})
    for (const std::string command : {"analyze", "report"})
      folder_.expect_refusal(command + " sweep -o sweep/" + in_order[0] + file, 2,
                             "is read, and must not be");
  folder_.expect_refusal("analyze sweep -o sweep", 2, "sweep: is a folder");
}

TEST_F(SavedSweep, AJobsFolderStandsForItsRun) {
  const std::string job = "sweep/" + in_order[0];
  folder_.succeed("analyze " + job + " -o a.h5 -q");
  folder_.succeed("analyze " + job + "/run.h5 -o b.h5 -q");
  folder_.expect_same_datasets("a.h5", "b.h5");
  EXPECT_EQ(testing_program::run(folder_ / job, {"report", ".", "-q"}).code, 0);
  EXPECT_THAT(folder_.read(job + "/run.html"), HasSubstr("<td>" + in_order[0] + "</td>"));
}

TEST_F(SavedSweep, JobsThatAreNotFinishedAreNamed) {
  fs::remove(folder_ / "sweep/packing_fraction-0.3_seed-10/done.json");
  fs::remove(folder_ / "sweep/packing_fraction-0.4_seed-2/done.json");
  const std::string left_out =
      "2 of 4 jobs are finished; packing_fraction-0.3_seed-10, packing_fraction-0.4_seed-2 are "
      "left out";
  for (const std::string command : {"analyze sweep", "report sweep"}) {
    const Outcome told = folder_.run(command);
    EXPECT_EQ(told.code, 0);
    EXPECT_THAT(told.errors, HasSubstr("sweep: " + left_out + "\n"));
    EXPECT_EQ(folder_.run(command + " -q").errors, "");
  }
  const Results results = read_results(folder_ / "sweep/results.h5");
  EXPECT_EQ(results.find("runs")->rows(), 2u);
  EXPECT_THAT(results.provenance, testing::Contains(std::pair("left_out", left_out)));
  EXPECT_THAT(folder_.read("sweep/report.html"),
              AllOf(HasSubstr("; 2 of 4 jobs are finished</p>"), HasSubstr(left_out)));
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "sweep"))
    if (entry.path().filename() == "done.json") fs::remove(entry.path());
  folder_.expect_refusal("analyze sweep", 2, "none of the 4 jobs of this sweep is finished");
  folder_.expect_refusal("analyze .", 2, "is neither the folder of a sweep nor that of a job");
}

TEST_F(SavedSweep, QuietItSaysNothing) {
  const Outcome quiet = folder_.run("sweep p.toml -o sweep -q");
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.output + quiet.errors, "");
  EXPECT_EQ(folder_.summary("sweep p.toml -o sweep")["jobs"].size(), 4u);
}

/// The chart's columns in the names that a table has: `#` is a number, `*` any text.
bool has_column(const Table& table, std::string column) {
  for (const auto& [placeholder, pattern] : {std::pair("#", "[0-9]+"), std::pair("*", ".+")})
    if (const auto at = column.find(placeholder); at != std::string::npos)
      column.replace(at, 1, pattern);
  return std::ranges::any_of(table.columns, [&](const Column& found) {
    return std::regex_match(found.name, std::regex(column));
  });
}

/// What `analyze` says of this run is in its list, and its charts are of columns that are there.
void expect_listed(const Results& results, int dimension) {
  const std::vector<Observable> all = observables(dimension);
  for (const Table& table : results.tables) EXPECT_TRUE(find(all, table.name)) << table.name;
  for (const Observable& observable : all) {
    const auto table = std::ranges::find_if(
        results.tables, [&](const Table& found) { return find(all, found.name) == &observable; });
    ASSERT_NE(table, results.tables.end()) << observable.table;
    for (const Chart& chart : observable.charts) {
      EXPECT_TRUE(table->find(chart.x)) << chart.heading;
      for (const auto& curves : {chart.curves, chart.references})
        for (const Curve& curve : curves)
          EXPECT_TRUE(has_column(*table, curve.column)) << observable.table << ' ' << curve.column;
    }
  }
}

TEST(SavedRuns, EveryTableIsListedWithWhatItIs) {
  const std::string species = "[[species]]\nname = \"A\"\nfraction = 0.5\n";
  const std::string other = "[[species]]\nname = \"B\"\nfraction = 0.5\n";
  const std::string space = "[system]\ndimension = 3\npacking_fraction = 0.1\nparticles = 20\n";
  const std::map<int, std::string> files = {
      {2, tiny_system + species + "aspect_ratio = 2\n" + other + "aspect_ratio = 3\n"},
      {3, space + tiny_system.substr(tiny_system.find("[prepare]")) + "[[prepare.stage]]\n" +
              "method = \"insert\"\npacking_fraction = 0.1\n" + species +
              "aspect_ratios = [1.5, 2]\n" + other + "aspect_ratios = [2, 3]\n"}};
  for (const auto& [dimension, parameters] : files) {
    const Folder folder("listed_" + std::to_string(dimension), parameters);
    // Between frames no body turns so far that the number of turns would be unknown.
    folder.succeed("run p.toml -o run.h5 -q --set output.samples.interval=0.1");
    folder.succeed("analyze run.h5 -q --set 'analysis.waiting_times=[0, 0.5]'");
    const Results results = read_results(folder / "run_results.h5");
    expect_listed(results, dimension);
    EXPECT_THAT(results.text("command_line"), StartsWith("vitrel run p.toml "));
  }
}

TEST(SavedRuns, TheListOfTablesNeedsNoRun) {
  const Folder folder("list");
  EXPECT_THAT(folder.succeed("analyze --list"), HasSubstr("## `structure_factor`"));
  folder.expect_refusals(
      {{"analyze", 2, "name a run or the folder of a sweep"},
       {"analyze --list run.h5", 2, "--list"},
       {"analyze run.h5 --only msd,fss", 2,
        "--only: names the table \"fss\", which `vitrel analyze --list` does not have"}});
}

// The stress of other runs says nothing of a viscosity, and is not stored.
TEST(SavedRuns, OnlyElasticNewtonianRunsHaveAViscosity) {
  const Folder folder("viscosity",
                      "[system]\nparticles = 50\npacking_fraction = 0.2\n[[species]]\n"
                      "aspect_ratio = 1\n[dynamics]\nduration = 4000\n"
                      "[output]\nsamples = { interval = 4 }\n");
  auto analysed = [&, runs = 0](const std::string& setting) mutable {
    const std::string file = "run" + std::to_string(++runs) + ".h5";
    folder.succeed("run p.toml -o " + file + " -q --set " + setting);
    return folder.summary("analyze " + file + " --only viscosity");
  };
  const auto elastic = analysed("dynamics.restitution=1.0");
  EXPECT_GT(elastic["viscosity"], 0);
  EXPECT_GT(elastic["viscosity_error"], 0);
  for (const char* other : {"dynamics.kind=\"brownian\"", "dynamics.restitution=0.99"})
    EXPECT_FALSE(analysed(other).contains("viscosity")) << other;
}

}  // namespace
}  // namespace vitrel
