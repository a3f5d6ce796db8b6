// Analysis, report and export of saved runs and sweeps from outside: what they take, what they refuse, and
// that no file is lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <span>
#include <sstream>

#include "analysis/observables/observable.h"
#include "analysis/results.h"
#include "analysis/statistics/blocking.h"
#include "tests/app/program.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing_program::expect_refusal;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;

const std::string tiny_system =
    "[system]\nparticles = 20\n[prepare]\nquality_sweeps = 10\n"
    "[dynamics]\nequilibration = 1\nduration = 10\n"
    "[output]\nsamples = { spacing = \"linear\", interval = 0.5 }\n"
    "correlations = { interval = 0.5 }\n";

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A state and a run of it.
void write_run(const Folder& folder) {
  folder.write("p.toml", tiny_system);
  ASSERT_EQ(run(folder.path(), {"prepare", "p.toml", "-o", "state.h5", "-q"}).code, 0);
  ASSERT_EQ(run(folder.path(), {"run", "p.toml", "--from", "state.h5", "-o", "run.h5", "-q"}).code,
            0);
}

// What was chosen to simulate the particles stands in the plan, in the summary, in the file and on the page.
TEST(SavedRuns, StatesAndRunsSayHowTheyWereMade) {
  const Folder folder("model");
  folder.write("p.toml",
               tiny_system +
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
  const auto expect_model = [&](std::vector<std::string> command, const std::string& file,
                                const std::string& model) {
    command.insert(command.end(), {"-o", file});
    std::vector<std::string> plan = command;
    plan.push_back("--dry-run");
    EXPECT_THAT(run(folder.path(), plan).output, HasSubstr("prepares by  " + preparation + "\n"));
    command.insert(command.end(), {"--json", "-q"});
    const Outcome made = run(folder.path(), command);
    ASSERT_EQ(made.code, 0) << made.errors;
    EXPECT_EQ(nlohmann::json::parse(made.output)["model"], model);
    ASSERT_EQ(run(folder.path(), {"report", file, "-o", "page.html", "-q"}).code, 0);
    EXPECT_THAT(content(folder / "page.html"), HasSubstr(model));
  };
  expect_model({"prepare", "p.toml"}, "state.h5", preparation);
  expect_model({"run", "p.toml"}, "run.h5", dynamics + "; prepared by " + preparation);
  const Outcome from =
      run(folder.path(), {"run", "p.toml", "--from", "state.h5", "-o", "from.h5", "--json", "-q"});
  EXPECT_EQ(nlohmann::json::parse(from.output)["model"], dynamics);
}

TEST(SavedRuns, NoCommandOverwritesWhatItReads) {
  const Folder folder("overwrites_input");
  write_run(folder);
  fs::create_symlink("run.h5", folder / "link.h5");
  std::map<std::string, std::string> before;
  for (const char* name : {"p.toml", "state.h5", "run.h5"}) before[name] = content(folder / name);
  const char* is_read = "is read, and must not be overwritten; choose another output";
  for (const char* command : {"analyze", "report"})
    for (const char* output : {"run.h5", "./run.h5", "link.h5"})
      expect_refusal(run(folder.path(), {command, "run.h5", "-o", output}), 2, is_read);
  for (const char* command : {"analyze", "report"})
    expect_refusal(run(folder.path(), {command, "run.h5", "--params", "p.toml", "-o", "p.toml"}), 2,
                   is_read);
  expect_refusal(run(folder.path(), {"report", "state.h5", "-o", "state.h5"}), 2, is_read);
  expect_refusal(run(folder.path(), {"run", "p.toml", "--from", "run.h5", "-o", "run.h5"}), 2,
                 is_read);
  expect_refusal(run(folder.path(), {"run", "p.toml", "-o", "p.toml"}), 2, is_read);
  expect_refusal(run(folder.path(), {"prepare", "p.toml", "-o", "p.toml"}), 2, "exists already");
  expect_refusal(run(folder.path(), {"export", "run.h5", "--to", "xyz", "-o", "run.h5"}), 2,
                 "exists already");
  for (const auto& [name, bytes] : before) EXPECT_EQ(content(folder / name), bytes) << name;
}

TEST(SavedRuns, AnalysisOverwritesNothingButItsResults) {
  const Folder folder("overwrites_others");
  write_run(folder);
  folder.write("notes.txt", "mine");
  fs::copy_file(folder / "run.h5", folder / "other.h5");
  fs::copy_file(folder / "run.h5.correlations.h5", folder / "correlations.h5");
  for (const char* output : {"notes.txt", "other.h5", "state.h5", "correlations.h5"}) {
    const std::string before = content(folder / output);
    expect_refusal(run(folder.path(), {"analyze", "run.h5", "-o", output}), 2,
                   std::string(output) + ": exists and holds no results of vitrel analyze");
    EXPECT_EQ(content(folder / output), before);
  }
  expect_refusal(run(folder.path(), {"analyze", "run.h5", "-o", "."}), 2, ".: is a folder");
  expect_refusal(run(folder.path(), {"analyze", "run.h5", "-o", "/dev/null"}), 2,
                 "/dev/null: is a device");
  ASSERT_EQ(run(folder.path(), {"analyze", "run.h5", "-q"}).code, 0);
  const std::string first = content(folder / "run_results/displacements_all.csv");
  ASSERT_EQ(
      run(folder.path(), {"analyze", "run.h5", "-q", "--set", "analysis.longest_lag=0.1"}).code, 0);
  EXPECT_LT(content(folder / "run_results/displacements_all.csv").size(), first.size() / 2);
}

TEST(SavedRuns, AReportOverwritesNothingButPages) {
  const Folder folder("overwrites_no_page");
  write_run(folder);
  ASSERT_EQ(run(folder.path(), {"analyze", "run.h5", "-q"}).code, 0);
  for (const char* output : {"run_results.h5", "p.toml", "state.quality.json"}) {
    const std::string before = content(folder / output);
    for (const char* input : {"run.h5", "state.h5"})
      expect_refusal(run(folder.path(), {"report", input, "-o", output}), 2,
                     std::string(output) + ": exists and is not an HTML page");
    EXPECT_EQ(content(folder / output), before);
  }
  folder.write("run.html", "<!DOCTYPE html>\n<p>an earlier one");
  EXPECT_EQ(run(folder.path(), {"report", "run.h5", "-q"}).code, 0);
  EXPECT_GT(fs::file_size(folder / "run.html"), 10'000u);
}

TEST(SavedRuns, TheSummaryGivesErrorsBesideTheirValues) {
  const Folder folder("summary");
  folder.write("p.toml", tiny_system);
  // Many samples, so that the errors are known.
  ASSERT_EQ(run(folder.path(),
                {"run", "p.toml", "-o", "run.h5", "-q", "--set", "output.samples.interval=0.02"})
                .code,
            0);
  const std::string text = run(folder.path(), {"analyze", "run.h5"}).output;
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
  const Folder folder("slash");
  folder.write("p.toml", tiny_system);
  ASSERT_EQ(
      run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q", "--set", "system.dimension=3"})
          .code,
      0);
  const Outcome outcome =
      run(folder.path(), {"export", "run.h5", "--to", "vtp", "-o", "bodies/", "-q"});
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_TRUE(fs::is_directory(folder / "bodies"));
}

TEST(SavedRuns, OfTablesThatAreGoneNothingStays) {
  const Folder folder("gone_tables");
  write_run(folder);
  ASSERT_EQ(run(folder.path(), {"analyze", "run.h5", "-q"}).code, 0);
  folder.write("run_results/notes.csv", "mine");
  ASSERT_TRUE(fs::exists(folder / "run_results/on_the_fly_all.csv"));
  fs::remove(folder / "run.h5.correlations.h5");
  ASSERT_EQ(run(folder.path(), {"analyze", "run.h5", "-q"}).code, 0);
  EXPECT_FALSE(fs::exists(folder / "run_results/on_the_fly_all.csv"));
  EXPECT_TRUE(fs::exists(folder / "run_results/notes.csv"));
  for (const Table& table : read_results(folder / "run_results.h5").tables)
    EXPECT_TRUE(fs::exists(folder / ("run_results/" + table.name + ".csv"))) << table.name;
}

// The input is no run, so that no message about the output can come after the work.
TEST(SavedRuns, TheOutputIsLookedAtFirst) {
  const Folder folder("missing_folder");
  folder.write("p.toml", tiny_system);
  folder.write("no_run.h5", "");
  const std::vector<std::vector<std::string>> commands = {{"prepare", "p.toml"},
                                                          {"run", "p.toml"},
                                                          {"run", "p.toml", "--from", "no_run.h5"},
                                                          {"analyze", "no_run.h5"},
                                                          {"export", "no_run.h5", "--to", "gsd"}};
  for (std::vector<std::string> command : commands) {
    command.insert(command.end(), {"-o", "absent/output"});
    expect_refusal(
        run(folder.path(), command), 3,
        "absent/output: cannot be written: there is no folder " + (folder / "absent").string());
  }
  expect_refusal(run(folder.path(), {"analyze", "no_run.h5", "-o", "p.toml"}), 2,
                 "p.toml: exists and holds no");
  expect_refusal(run(folder.path(), {"analyze", "absent.h5"}), 3,
                 "absent.h5: there is no such file");
}

TEST(SavedRuns, SettingsWithoutEffectAreRefused) {
  const Folder folder("no_effect");
  write_run(folder);
  for (const char* command : {"analyze", "report"}) {
    expect_refusal(run(folder.path(), {command, "run.h5", "--set", "dynamics.duration=5"}), 2,
                   "--set dynamics.duration=5: has no effect on an existing run; only "
                   "analysis.… and import.… can be set");
    expect_refusal(run(folder.path(), {command, "run.h5", "--set", "analysis.longest_leg=1"}), 2,
                   "key 'analysis.longest_leg' is unknown");
  }
  const char* no_analysis = "is a single state, whose page holds no analysis";
  expect_refusal(run(folder.path(), {"report", "state.h5", "--params", "p.toml"}), 2, no_analysis);
  expect_refusal(run(folder.path(), {"report", "state.h5", "--set", "analysis.longest_lag=0.1"}), 2,
                 no_analysis);
  EXPECT_FALSE(fs::exists(folder / "state.html"));
}

/// Densities and seeds whose order is neither that of the jobs nor that of their names.
const std::string four_jobs = tiny_system +
                              "[sweep.grid]\n\"system.packing_fraction\" = [0.4, 0.3]\n"
                              "\"system.seed\" = [10, 2]\n";

class SavedSweep : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("p.toml", four_jobs);
    ASSERT_EQ(run(folder_.path(), {"sweep", "p.toml", "-o", "sweep", "-j", "2", "-q"}).code, 0);
  }
  fs::path job(const std::string& id) const { return folder_ / "sweep" / id; }

  const Folder folder_{"saved_sweep"};
};

TEST_F(SavedSweep, RunsAreOrderedByDensityThenBySeed) {
  ASSERT_EQ(run(folder_.path(), {"analyze", "sweep", "-q"}).code, 0);
  const Results results = read_results(folder_ / "sweep/results.h5");
  std::vector<std::string> rows;
  for (std::string file; !(file = results.text("row_" + std::to_string(rows.size()))).empty();)
    rows.push_back(fs::path(file).parent_path().filename());
  EXPECT_THAT(rows, ElementsAre("packing_fraction-0.3_seed-2", "packing_fraction-0.3_seed-10",
                                "packing_fraction-0.4_seed-2", "packing_fraction-0.4_seed-10"));
  const Table& runs = *results.find("runs");
  for (std::size_t k = 0; k < 4; ++k) {
    const Results of_job = read_results(job(rows[k]) / "results.h5");
    EXPECT_EQ(runs.find("collisions")->value[k],
              of_job.find("summary")->find("collisions")->value[0]);
  }
  ASSERT_EQ(run(folder_.path(), {"report", "sweep", "-q"}).code, 0);
  const std::string page = content(folder_ / "sweep/report.html");
  std::size_t place = 0;
  for (const std::string& row : rows) {
    place = page.find("<td>" + row + "</td>", place);
    EXPECT_NE(place, std::string::npos) << row;
  }
}

// Two values d apart have the 95 % interval ± tan(0.95 π/2) d/2: Student's quantile for one degree of freedom.
TEST_F(SavedSweep, SeedsAreAveraged) {
  ASSERT_EQ(run(folder_.path(), {"analyze", "sweep", "-q"}).code, 0);
  const Results results = read_results(folder_ / "sweep/results.h5");
  const Table& runs = *results.find("runs");
  EXPECT_THAT(runs.find("seed")->value, ElementsAre(2, 10, 2, 10));
  const Table& seeds = *results.find("seeds");
  EXPECT_THAT(seeds.find("system_packing_fraction")->value, ElementsAre(0.3, 0.4));
  EXPECT_THAT(seeds.find("seeds")->value, ElementsAre(2, 2));
  EXPECT_THAT(runs.find("job")->labels,
              ElementsAre("packing_fraction-0.3_seed-2", "packing_fraction-0.3_seed-10",
                          "packing_fraction-0.4_seed-2", "packing_fraction-0.4_seed-10"));
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
  ASSERT_EQ(run(folder_.path(), {"analyze", "sweep", "-q"}).code, 0);
  const std::string plain = content(folder_ / "sweep/results/runs.csv");
  std::map<fs::path, std::string> before;
  for (const auto& entry : fs::recursive_directory_iterator(job("packing_fraction-0.3_seed-2")))
    if (entry.is_regular_file()) before[entry.path()] = content(entry.path());
  ASSERT_EQ(
      run(folder_.path(), {"analyze", "sweep", "-q", "--set", "analysis.longest_lag=0.2"}).code, 0);
  for (const auto& [file, text] : before) EXPECT_EQ(content(file), text) << file;
  // Diffusion comes from the longest time differences.
  EXPECT_NE(content(folder_ / "sweep/results/runs.csv"), plain);
  ASSERT_EQ(run(folder_.path(), {"analyze", "sweep", "-q"}).code, 0);
  EXPECT_EQ(content(folder_ / "sweep/results/runs.csv"), plain);
}

TEST_F(SavedSweep, ItsOwnFilesAreNotOverwritten) {
  const std::string id = "sweep/packing_fraction-0.3_seed-2/";
  for (const char* file : {"run.h5", "results.h5"})
    for (const char* command : {"analyze", "report"})
      expect_refusal(run(folder_.path(), {command, "sweep", "-o", id + file}), 2,
                     "is read, and must not be");
  expect_refusal(run(folder_.path(), {"analyze", "sweep", "-o", "sweep"}), 2, "sweep: is a folder");
}

TEST_F(SavedSweep, AJobsFolderStandsForItsRun) {
  const std::string id = "packing_fraction-0.3_seed-2";
  ASSERT_EQ(run(folder_.path(), {"analyze", "sweep/" + id, "-o", "a.h5", "-q"}).code, 0);
  ASSERT_EQ(run(folder_.path(), {"analyze", "sweep/" + id + "/run.h5", "-o", "b.h5", "-q"}).code,
            0);
  EXPECT_THAT(testing_program::differing_datasets(folder_ / "a.h5", folder_ / "b.h5"),
              testing::IsEmpty());
  ASSERT_EQ(run(job(id), {"report", ".", "-q"}).code, 0);
  EXPECT_THAT(content(job(id) / "run.html"), HasSubstr("<td>" + id + "</td>"));
}

TEST_F(SavedSweep, JobsThatAreNotFinishedAreNamed) {
  fs::remove(job("packing_fraction-0.3_seed-10") / "done.json");
  fs::remove(job("packing_fraction-0.4_seed-2") / "done.json");
  const std::string left_out =
      "2 of 4 jobs are finished; packing_fraction-0.3_seed-10, packing_fraction-0.4_seed-2 are "
      "left out";
  for (const char* command : {"analyze", "report"}) {
    const Outcome told = run(folder_.path(), {command, "sweep"});
    EXPECT_EQ(told.code, 0);
    EXPECT_THAT(told.errors, HasSubstr("sweep: " + left_out + "\n"));
    EXPECT_EQ(run(folder_.path(), {command, "sweep", "-q"}).errors, "");
  }
  const Results results = read_results(folder_ / "sweep/results.h5");
  EXPECT_EQ(results.find("runs")->rows(), 2u);
  EXPECT_THAT(results.provenance, testing::Contains(std::pair("left_out", left_out)));
  EXPECT_THAT(content(folder_ / "sweep/report.html"),
              AllOf(HasSubstr("; 2 of 4 jobs are finished</p>"), HasSubstr(left_out)));
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "sweep"))
    if (entry.path().filename() == "done.json") fs::remove(entry.path());
  expect_refusal(run(folder_.path(), {"analyze", "sweep"}), 2,
                 "none of the 4 jobs of this sweep is finished");
  expect_refusal(run(folder_.path(), {"analyze", "."}), 2,
                 "is neither the folder of a sweep nor that of a job");
}

TEST_F(SavedSweep, QuietItSaysNothing) {
  std::vector<std::string> again = {"sweep", "p.toml", "-o", "sweep", "-q"};
  const Outcome quiet = run(folder_.path(), again);
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.output + quiet.errors, "");
  again.push_back("--json");
  EXPECT_EQ(nlohmann::json::parse(run(folder_.path(), again).output)["jobs"].size(), 4u);
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
  const std::string often = "output.samples.interval=0.1";
  for (const auto& [dimension, parameters] : files) {
    const Folder folder("listed_" + std::to_string(dimension));
    folder.write("p.toml", parameters);
    // Between frames no body turns so far that the number of turns would be unknown.
    ASSERT_EQ(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q", "--set", often}).code, 0);
    const std::string waiting = "analysis.waiting_times=[0, 0.5]";
    ASSERT_EQ(run(folder.path(), {"analyze", "run.h5", "-q", "--set", waiting}).code, 0);
    const Results results = read_results(folder / "run_results.h5");
    expect_listed(results, dimension);
    EXPECT_THAT(results.text("command_line"), StartsWith("vitrel run p.toml "));
  }
}

TEST(SavedRuns, TheListOfTablesNeedsNoRun) {
  const Folder folder("list");
  const Outcome list = run(folder.path(), {"analyze", "--list"});
  EXPECT_EQ(list.code, 0);
  EXPECT_THAT(list.output, HasSubstr("## `structure_factor`"));
  expect_refusal(run(folder.path(), {"analyze"}), 2, "name a run or the folder of a sweep");
  expect_refusal(run(folder.path(), {"analyze", "--list", "run.h5"}), 2, "--list");
  expect_refusal(run(folder.path(), {"analyze", "run.h5", "--only", "msd,fss"}), 2,
                 "--only: names the table \"fss\", which `vitrel analyze --list` does not have");
}

// The stress of other runs says nothing of a viscosity, and is not stored.
TEST(SavedRuns, OnlyElasticNewtonianRunsHaveAViscosity) {
  const Folder folder("viscosity");
  folder.write("p.toml",
               "[system]\nparticles = 50\npacking_fraction = 0.2\n[[species]]\n"
               "aspect_ratio = 1\n[dynamics]\nduration = 4000\n"
               "[output]\nsamples = { interval = 4 }\n");
  int runs = 0;
  const auto analysed = [&](const std::string& setting) {
    const std::string file = "run" + std::to_string(++runs) + ".h5";
    succeed(folder, {"run", "p.toml", "-o", file, "-q", "--set", setting});
    return summary_of(folder, {"analyze", file, "--only", "viscosity"});
  };
  const auto elastic = analysed("dynamics.restitution=1.0");
  EXPECT_GT(elastic["viscosity"], 0);
  EXPECT_GT(elastic["viscosity_error"], 0);
  for (const char* other : {"dynamics.kind=\"brownian\"", "dynamics.restitution=0.99"})
    EXPECT_FALSE(analysed(other).contains("viscosity")) << other;
}

}  // namespace
}  // namespace vitrel
