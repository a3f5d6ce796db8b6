// The program from outside: what it prints, writes and returns.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <future>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "analysis/results.h"
#include "core/io/checked.h"
#include "core/io/h5md.h"
#include "tests/app/program.h"
#include "tests/support/partial_files.h"

namespace vitrel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing_program::differing_datasets;
using testing_program::expect_refusal;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using Json = nlohmann::json;

const std::string small_system =
    "[system]\nparticles = 30\n[dynamics]\nequilibration = 1\nduration = 10\n"
    "[output]\nsamples = { spacing = \"linear\", interval = 0.5 }\n";

void expect_keys(const Json& summary, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(summary.contains(key)) << key;
}

TEST(Program, PrepareRunCheckAnalyzeAndReport) {
  const Folder folder("whole_way");
  folder.write("p.toml", small_system);
  const Outcome prepared =
      run(folder.path(), {"prepare", "p.toml", "-o", "state.h5", "--json", "-q"});
  ASSERT_EQ(prepared.code, 0) << prepared.errors;
  const Json preparation = Json::parse(prepared.output);
  expect_keys(preparation,
              {"packing_fraction", "wall_seconds", "trial_moves", "trial_moves_per_second",
               "acceptance_translation", "acceptance_rotation", "nematic_order", "overlaps"});
  EXPECT_NEAR(preparation["packing_fraction"], 0.5, 1e-12);
  EXPECT_EQ(preparation["overlaps"], 0);

  const Outcome ran =
      run(folder.path(), {"run", "p.toml", "-o", "run.h5", "--from", "state.h5", "--json", "-q"});
  ASSERT_EQ(ran.code, 0) << ran.errors;
  const Json summary = Json::parse(ran.output);
  expect_keys(summary, {"collisions", "simulated_time", "wall_seconds", "collisions_per_second",
                        "collisions_per_second_with_output", "predictions_per_collision",
                        "correction_moves", "energy_drift", "packing_fraction",
                        "compressibility_factor", "compressibility_factor_error", "overlaps"});
  EXPECT_EQ(summary["compressibility"], summary["compressibility_factor"]);  // its former key
  EXPECT_EQ(summary["simulated_time"], 11);
  EXPECT_EQ(summary["frames"], 21);
  EXPECT_EQ(summary["correction_moves"], 0);
  EXPECT_LE(summary["energy_drift"], 1e-12);
  EXPECT_GT(summary["collisions"], 100);
  EXPECT_GT(summary["collisions_per_second"], summary["collisions_per_second_with_output"]);

  const Outcome checked = run(folder.path(), {"check", "run.h5", "--json", "-q"});
  ASSERT_EQ(checked.code, 0) << checked.errors;
  const Json check = Json::parse(checked.output);
  EXPECT_EQ(check["frames"], 21);
  EXPECT_EQ(check["overlaps"], 0);
  EXPECT_GT(check["smallest_gap"], 0);

  EXPECT_EQ(run(folder.path(), {"analyze", "run.h5", "-o", "results.h5", "-q"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "results.h5"));
  for (const char* table : {"displacements_all", "self_scattering_all", "orientation_all",
                            "wave_numbers", "collective_scattering", "susceptibility"})
    EXPECT_TRUE(std::filesystem::exists(folder / (std::string("results/") + table + ".csv")))
        << table;
  EXPECT_EQ(run(folder.path(), {"report", "run.h5", "-o", "page.html", "-q"}).code, 0);
  EXPECT_GT(std::filesystem::file_size(folder / "page.html"), 10'000u);
}

// Where the run correlates the states it writes, both analyses average over the same: lags up to 7, which
// have all origins.
TEST(Program, CorrelatesOnTheFly) {
  const Folder folder("correlates");
  folder.write("p.toml",
               small_system + "correlations = { interval = 0.5, wave_numbers = [2, 3] }\n");
  const Outcome plan = run(folder.path(), {"run", "p.toml", "-o", "run.h5", "--dry-run"});
  EXPECT_THAT(plan.output, HasSubstr("correlates   every 0.5, into run.h5.correlations.h5"));
  const Outcome ran = run(folder.path(), {"run", "p.toml", "-o", "run.h5", "--json", "-q"});
  ASSERT_EQ(ran.code, 0) << ran.errors;
  EXPECT_EQ(Json::parse(ran.output)["correlations"], "run.h5.correlations.h5");
  ASSERT_EQ(run(folder.path(), {"analyze", "run.h5", "-o", "results.h5", "-q"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "results/on_the_fly_all.csv"));
  const Results results = read_results(folder / "results.h5");
  const Table* measured = results.find("on_the_fly_all");
  const Table* stored = results.find("displacements_all");
  ASSERT_TRUE(measured && stored);
  EXPECT_EQ(results.find("on_the_fly_wave_numbers")->find("q")->value, (std::vector<double>{2, 3}));
  for (const std::string name : {"time", "msd", "msr", "origins"})
    for (std::size_t k = 0; k < 7; ++k)
      EXPECT_NEAR(measured->find(name)->value.at(k), stored->find(name)->value.at(k), 1e-12)
          << name << " " << k;
  EXPECT_EQ(measured->find("time")->value,
            (std::vector<double>{0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 5}));
  EXPECT_TRUE(measured->find("fs_2"));
}

// Correlations belong to the run beside which they lie, and are never those of an earlier one.
TEST(Program, ANewRunForgetsTheCorrelationsOfAnEarlierOne) {
  const Folder folder("forgets");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q", "--set",
                                "output.correlations.interval=0.1"})
                .code,
            0);
  ASSERT_TRUE(std::filesystem::exists(folder / "run.h5.correlations.h5"));
  for (const std::string end : {"", ".checkpoint", ".checkpoint.previous"})
    std::filesystem::remove(folder / ("run.h5" + end));
  ASSERT_EQ(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q"}).code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "run.h5.correlations.h5"));
}

TEST(Program, PrepareReportsTheQualityOfTheState) {
  const Folder folder("quality");
  folder.write("p.toml", small_system);
  const Outcome told = run(folder.path(), {"prepare", "p.toml", "-o", "state.h5"});
  ASSERT_EQ(told.code, 0) << told.errors;
  EXPECT_THAT(told.output, AllOf(HasSubstr("reduced pressure"), HasSubstr("nematic order"),
                                 HasSubstr("hexatic order"), HasSubstr("displacement time"),
                                 HasSubstr("exact check: 0 overlaps")));
  EXPECT_THAT(partial_files(folder.path()), testing::IsEmpty());
  const Outcome asked = run(folder.path(), {"prepare", "p.toml", "-o", "same.h5", "--json", "-q"});
  ASSERT_EQ(asked.code, 0) << asked.errors;
  const Json summary = Json::parse(asked.output);
  EXPECT_EQ(summary["quality_report"], "same.quality.json");
  const Json file = Json::parse(std::ifstream(folder / "same.quality.json"));
  EXPECT_EQ(summary["quality"], file);
  expect_keys(file, {"packing_fraction", "reduced_pressure", "nematic_order", "nematic_correlation",
                     "hexatic_order", "overlaps", "smallest_gap", "jamming", "time_correlation"});
  EXPECT_NEAR(file["packing_fraction"], 0.5, 1e-12);
  EXPECT_EQ(file["overlaps"], 0);
  EXPECT_EQ(file["reduced_pressure"]["from"], "sampling");
  EXPECT_EQ(file["time_correlation"]["measured_sweeps"], 800);
  // The seed decides this file, too.
  EXPECT_EQ(file, Json::parse(std::ifstream(folder / "state.quality.json")));

  EXPECT_EQ(run(folder.path(), {"report", "state.h5", "-q"}).code, 0);
  std::ifstream page(folder / "state.html");
  const std::string text(std::istreambuf_iterator<char>(page), {});
  EXPECT_THAT(text,
              AllOf(HasSubstr("reduced pressure"), HasSubstr("30 ellipses, κ = 2 at φ = 0.5")));
}

TEST(Program, AStateIsNotReportedWithoutItsQuality) {
  const Folder folder("no_quality");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"prepare", "p.toml", "-o", "state.h5", "-q"}).code, 0);
  ASSERT_EQ(run(folder.path(), {"prepare", "p.toml", "-o", "b.h5", "-q", "--seed", "2"}).code, 0);
  std::filesystem::copy_file(folder / "b.quality.json", folder / "state.quality.json",
                             std::filesystem::copy_options::overwrite_existing);
  expect_refusal(run(folder.path(), {"report", "state.h5", "-q"}), 3,
                 "state.quality.json: is the quality report of another state");
  std::filesystem::remove(folder / "state.quality.json");
  expect_refusal(run(folder.path(), {"report", "state.h5", "-q"}), 3,
                 "state.quality.json: is missing");
  EXPECT_FALSE(std::filesystem::exists(folder / "state.html"));
}

TEST(Program, ACompleteRunIsLeftAlone) {
  const Folder folder("complete");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q"}).code, 0);
  const auto written = std::filesystem::last_write_time(folder / "run.h5");
  const Outcome again = run(folder.path(), {"run", "p.toml", "-o", "run.h5"});
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.errors, HasSubstr("complete already"));
  EXPECT_EQ(std::filesystem::last_write_time(folder / "run.h5"), written);
}

TEST(Program, ARunIsNotContinuedWithOtherParameters) {
  const Folder folder("other_parameters");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q"}).code, 0);
  expect_refusal(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q", "--seed", "2"}), 2,
                 "begun with system.seed = 1, but now it is 2");
  expect_refusal(run(folder.path(), {"prepare", "p.toml", "-o", "run.h5", "-q"}), 2,
                 "exists already");
  std::filesystem::remove(folder / "run.h5.checkpoint");
  std::filesystem::remove(folder / "run.h5.checkpoint.previous");
  expect_refusal(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q"}), 2,
                 "has no checkpoint");
}

TEST(Program, AStateMustFitTheParameters) {
  const Folder folder("fit");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"prepare", "p.toml", "-o", "state.h5", "-q"}).code, 0);
  const auto run_with = [&](const std::string& setting) {
    return run(folder.path(),
               {"run", "p.toml", "-o", "run.h5", "--from", "state.h5", "-q", "--set", setting});
  };
  expect_refusal(run_with("system.particles=31"), 2,
                 "key 'system.particles' is 31, but that of the state is 30 (state.h5)");
  expect_refusal(run_with("system.packing_fraction=0.4"), 2,
                 "key 'system.packing_fraction' is 0.4, but that of the state is");
  expect_refusal(run_with("dynamics.initial_velocities=keep"), 2, "is at rest");
  // Before it does anything, the plan refuses the same.
  for (const auto& [setting, complaint] :
       {std::pair("system.particles=31", "key 'system.particles' is 31"),
        {"dynamics.initial_velocities=keep", "is at rest"}})
    expect_refusal(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "--from", "state.h5",
                                       "--dry-run", "--set", setting}),
                   2, complaint);
  expect_refusal(run(folder.path(), {"run", "p.toml", "-o", "state.h5", "--dry-run"}), 2,
                 "state.h5: exists, but has no checkpoint beside it");
}

// What a run records is what ran, whatever the parameter file says or leaves out.
TEST(Program, TheSpeciesOfAStateWin) {
  const Folder folder("species_of_state");
  folder.write("k14.toml", small_system + "[[species]]\naspect_ratio = 1.4\n");
  ASSERT_EQ(run(folder.path(), {"prepare", "k14.toml", "-o", "k14.h5", "-q"}).code, 0);
  folder.write("none.toml", small_system);
  folder.write("other.toml", small_system + "[[species]]\naspect_ratio = 2.0\n");
  const std::string contradiction =
      "other.toml:9:16: key 'species.0.aspect_ratio' is 2, but particle 0 has 1.4";
  for (const char* how : {"--quiet", "--dry-run"})
    expect_refusal(
        run(folder.path(), {"run", "other.toml", "-o", "run.h5", "--from", "k14.h5", how}), 2,
        contradiction);
  EXPECT_FALSE(std::filesystem::exists(folder / "run.h5.checkpoint"));
  const std::vector<std::string> from_none = {"run",    "none.toml", "-o",
                                              "run.h5", "--from",    "k14.h5"};
  const Outcome ran = run(folder.path(), from_none);
  ASSERT_EQ(ran.code, 0) << ran.errors;
  EXPECT_THAT(ran.errors, HasSubstr("species as in k14.h5"));
  EXPECT_THAT(TrajectoryReader(folder / "run.h5").provenance().parameters,
              HasSubstr("aspect_ratio = 1.4\n"));
  // The same command finds it complete, also without the state.
  std::filesystem::remove(folder / "k14.h5");
  EXPECT_EQ(run(folder.path(), from_none).code, 0);
  expect_refusal(
      run(folder.path(), {"run", "other.toml", "-o", "run.h5", "--from", "k14.h5", "-q"}), 2,
      contradiction);
}

TEST(Program, TheEnergyMayBeSplitAndSpeciesHeated) {
  const Folder folder("split_energy");
  folder.write("p.toml", small_system);
  const auto energies = [&](const std::string& output, const std::vector<std::string>& settings) {
    std::vector<std::string> words = {
        "run", "p.toml", "-o", output, "-q", "--set", "dynamics.equilibration=0"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const Outcome ran = run(folder.path(), words);
    EXPECT_EQ(ran.code, 0) << ran.errors;
    const Mechanics<2> sums = mechanics(TrajectoryReader(folder / output).read<2>(0));
    return std::array{sums.translational_energy, sums.rotational_energy};
  };
  // 30 ellipses: 30 kT and 15 kT.
  const auto split = energies("split.h5", {"dynamics.initial_velocities={ translation = 0.7 }"});
  EXPECT_NEAR(split[0], 0.7 * 45, 1e-12);
  EXPECT_NEAR(split[1], 0.3 * 45, 1e-12);
  const auto hot =
      energies("hot.h5", {"species.0.aspect_ratio=2", "species.0.initial_temperature=3"});
  EXPECT_NEAR(hot[0], 90, 1e-11);
  EXPECT_NEAR(hot[1], 45, 1e-11);
  expect_refusal(run(folder.path(), {"run", "p.toml", "-o", "a.h5", "--set",
                                     "dynamics.initial_velocities={ translation = 1.5 }"}),
                 2, "key 'dynamics.initial_velocities.translation' is 1.5");
}

/// Starts from state.h5 and is stopped after the first block, however slow the machine.
std::vector<std::string> stopped_run(const std::string& setting) {
  return {"run",
          "p.toml",
          "-o",
          "run.h5",
          "-q",
          "--from",
          "state.h5",
          "--set",
          setting,
          "--wall-time",
          "0.001",
          "--set",
          "dynamics.duration=1e6",
          "--set",
          "output.samples.interval=1e5"};
}

TEST(Program, ACheckpointWithoutItsTrajectoryIsRefusedAndKept) {
  const Folder folder("missing_trajectory");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"prepare", "p.toml", "-o", "state.h5", "-q"}).code, 0);
  const std::vector<std::string> whole = {"run", "p.toml", "-o", "run.h5", "-q"};
  const std::vector<std::string> dry = {"run", "p.toml", "-o", "run.h5", "--dry-run"};
  const auto refused = [&](const std::vector<std::string>& again) {
    std::filesystem::remove(folder / "run.h5");
    const std::string before = folder.read("run.h5.checkpoint");
    expect_refusal(run(folder.path(), again), 3,
                   "run.h5: is missing, but run.h5.checkpoint is there, the checkpoint of the run");
    EXPECT_FALSE(std::filesystem::exists(folder / "run.h5"));
    EXPECT_EQ(folder.read("run.h5.checkpoint"), before);
  };
  const auto forget = [&] {
    for (const char* file : {"run.h5.checkpoint", "run.h5.checkpoint.previous"})
      std::filesystem::remove(folder / file);
  };
  // The frame of time 0 is in the first block.
  ASSERT_EQ(run(folder.path(), stopped_run("dynamics.equilibration=0")).code, 5);
  refused(stopped_run("dynamics.equilibration=0"));
  forget();
  ASSERT_EQ(run(folder.path(), whole).code, 0);
  refused(whole);
  refused(dry);
  forget();
  EXPECT_EQ(run(folder.path(), whole).code, 0);
}

TEST(Program, ACheckpointBesideAnotherTrajectoryIsRefused) {
  const Folder folder("another_trajectory");
  folder.write("p.toml", small_system);
  const std::vector<std::string> whole = {"run", "p.toml", "-o", "run.h5", "-q"};
  const auto refused = [&](const std::vector<std::string>& change, const std::string& why) {
    std::vector<std::string> other = {"run", "p.toml", "-o", "other.h5", "-q"};
    other.insert(other.end(), change.begin(), change.end());
    succeed(folder, other);
    std::filesystem::rename(folder / "other.h5", folder / "run.h5");
    std::filesystem::remove(folder / "other.h5.checkpoint");
    std::filesystem::remove(folder / "other.h5.checkpoint.previous");
    const std::string before = folder.read("run.h5");
    expect_refusal(run(folder.path(), whole), 3, why);
    EXPECT_EQ(folder.read("run.h5"), before);
  };
  succeed(folder, whole);
  refused({"--seed", "77"}, "run.h5: was written with system.seed = 77, not 1, but");
  refused({"--set", "dynamics.duration=0.5"}, " frames instead of ");
}

// The first checkpoint is saved before the trajectory is made.
TEST(Program, ACheckpointBeforeTheFirstFrameNeedsNoTrajectory) {
  const Folder folder("no_frame_yet");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"prepare", "p.toml", "-o", "state.h5", "-q"}).code, 0);
  const std::vector<std::string> equilibrating = stopped_run("dynamics.equilibration=1e6");
  ASSERT_EQ(run(folder.path(), equilibrating).code, 5);
  ASSERT_TRUE(std::filesystem::remove(folder / "run.h5"));
  const Outcome continued = run(folder.path(), equilibrating);
  EXPECT_EQ(continued.code, 5) << continued.errors;
  EXPECT_TRUE(std::filesystem::exists(folder / "run.h5"));
}

TEST(Program, ADryRunWritesNothing) {
  const Folder folder("dry_run");
  folder.write("p.toml", small_system);
  const Outcome outcome = run(folder.path(), {"run", "p.toml", "-o", "run.h5", "--dry-run"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("30 particles"), HasSubstr("21 frames")));
  EXPECT_FALSE(std::filesystem::exists(folder / "run.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "run.h5.checkpoint"));
}

TEST(Program, EveryKindOfBadParameterFileExitsWithTwo) {
  const Folder folder("bad_files");
  const auto refuse = [&](const std::string& text, const std::string& part) {
    folder.write("p.toml", text);
    expect_refusal(run(folder.path(), {"run", "p.toml", "-o", "run.h5"}), 2, part);
  };
  refuse("[system\n", "vitrel run: p.toml:1:8: not valid TOML");
  refuse("[system]\nparticels = 3\n",
         "p.toml:2:1: key 'system.particels' is unknown; did you mean "
         "'particles'?");
  refuse("[system]\nparticles = \"a\"\n", "p.toml:2:13: key 'system.particles' must be an integer");
  refuse("[system]\nparticles = -3\n",
         "p.toml:2:13: key 'system.particles' is -3, but must be positive");
  EXPECT_FALSE(std::filesystem::exists(folder / "run.h5"));
  folder.write("p.toml", small_system);
  expect_refusal(
      run(folder.path(), {"run", "p.toml", "-o", "run.h5", "--set", "dynamics.durtion=1"}), 2,
      "--set dynamics.durtion=1: key 'dynamics.durtion' is unknown");
}

TEST(Program, MistakesOnTheCommandLineExitWithTwo) {
  const Folder folder("command_line");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"frobnicate"},
                                             {"run"},
                                             {"check", "--frames"},
                                             {"params"},
                                             {"params", "check"},
                                             {"params", "run", "--reference"},
                                             {"params", "--python", "--reference"},
                                             {"run", "p.toml", "-o", "r.h5", "--wall-time", "-1"},
                                             {"sweep", "p.toml", "-o", "s", "-j", "0"}})
    expect_refusal(run(folder.path(), arguments), 2, "vitrel");
}

TEST(Program, HelpFitsATerminalAndNamesTheExitCodesThatOccur) {
  const Folder folder("help");
  const std::map<std::string, std::vector<int>> codes = {
      {"prepare", {0, 2, 3, 4, 5}}, {"run", {0, 2, 3, 4, 5}}, {"check", {0, 2, 3, 4, 5}},
      {"analyze", {0, 2, 3, 5}},    {"report", {0, 2, 3, 5}}, {"sweep", {0, 2, 3, 4, 5}},
      {"export", {0, 2, 3, 5}},     {"params", {0, 2, 3}},    {"picture", {0, 2, 3, 5}}};
  for (const auto& [command, expected] : codes) {
    const Outcome help = run(folder.path(), {command, "--help"});
    EXPECT_EQ(help.code, 0);
    std::istringstream lines(help.output);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
    std::string footer = help.output.substr(help.output.find("Exit codes: "));
    std::replace(footer.begin(), footer.end(), '\n', ' ');
    std::vector<int> named;
    for (const char digit : std::string("0123456789"))
      if (footer.find(std::string{' ', digit, ' '}) != std::string::npos)
        named.push_back(digit - '0');
    EXPECT_EQ(named, expected) << command;
  }
}

// Whatever the analysis finds wrong comes with the file.
TEST(Program, AWaveNumberTooSmallForTheBoxIsRefusedNamingTheFile) {
  const Folder folder("small_wave_number");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q"}).code, 0);
  expect_refusal(
      run(folder.path(), {"analyze", "run.h5", "-q", "--set", "analysis.wave_numbers=[1e-3]"}), 2,
      "run.h5: the wave number 0.001000 is too small for the box");
}

TEST(Program, FilesThatCannotBeReadOrWrittenExitWithThree) {
  const Folder folder("files");
  folder.write("p.toml", small_system);
  expect_refusal(run(folder.path(), {"run", "absent.toml", "-o", "run.h5"}), 3, "absent.toml: ");
  // No process, whatever its rights, can make a file in a folder that is a file.
  for (const char* output : {"p.toml/run.h5", "absent/run.h5"}) {
    expect_refusal(run(folder.path(), {"run", "p.toml", "-o", output, "-q"}), 3, output);
    expect_refusal(run(folder.path(), {"prepare", "p.toml", "-o", output, "-q"}), 3, output);
  }
  expect_refusal(run(folder.path(), {"sweep", "p.toml", "-o", "p.toml/sweep", "-q"}), 3,
                 "p.toml/sweep");
  expect_refusal(run(folder.path(), {"check", "p.toml", "-q"}), 3, "p.toml: ");
  expect_refusal(run(folder.path(), {"check", "absent.h5", "-q"}), 3, "absent.h5: ");
}

TEST(Program, ATruncatedFileExitsWithThree) {
  const Folder folder("truncated");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q"}).code, 0);
  std::filesystem::resize_file(folder / "run.h5",
                               std::filesystem::file_size(folder / "run.h5") / 2);
  expect_refusal(run(folder.path(), {"check", "run.h5", "-q"}), 3, "run.h5");
  expect_refusal(run(folder.path(), {"analyze", "run.h5", "-q"}), 3, "run.h5");
  expect_refusal(run(folder.path(), {"report", "run.h5", "-q"}), 3, "run.h5");
  for (const char* checkpoint : {"run.h5.checkpoint", "run.h5.checkpoint.previous"})
    if (std::filesystem::exists(folder / checkpoint))
      std::filesystem::resize_file(folder / checkpoint, 100);
  expect_refusal(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q"}), 3,
                 "run.h5.checkpoint");
}

const std::string small_packing =
    "[system]\ndimension = 3\nparticles = 20\npacking_fraction = 0.2\n[[species]]\naspect_ratio = "
    "3\n"
    "[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"grow\"\ngrowth_rate = 0.1\n";

TEST(Program, PreparesAndChecksAPackingOfThreeDimensions) {
  const Folder folder("packing");
  folder.write("p.toml", small_packing);
  const Outcome prepared =
      run(folder.path(), {"prepare", "p.toml", "-o", "state.h5", "-q", "--json"});
  ASSERT_EQ(prepared.code, 0) << prepared.errors;
  const Json summary = Json::parse(prepared.output);
  EXPECT_NEAR(summary["packing_fraction"].get<double>(), 0.2, 1e-12);
  EXPECT_EQ(summary["overlaps"], 0);
  EXPECT_GT(summary["reduced_pressure"], 1);
  EXPECT_GT(summary["collisions"], 20);
  EXPECT_GE(summary["orientation_ratio"], 1);
  EXPECT_EQ(summary["stages"].size(), 2u);
  EXPECT_EQ(Json::parse(folder.read("state.quality.json"))["dimension"], 3);
  const Outcome checked = run(folder.path(), {"check", "state.h5", "-q", "--json"});
  ASSERT_EQ(checked.code, 0) << checked.errors;
  EXPECT_EQ(Json::parse(checked.output)["box"].size(), 3u);

  Configuration3 state = read_state<3>(folder / "state.h5");
  state.position[7] = state.position[3] + Vec3(0.1, 0.05, 0);
  state.box.wrap(state.position[7], state.image[7]);
  write_state(folder / "overlap.h5", state, Provenance{});
  const Outcome overlapping = run(folder.path(), {"check", "overlap.h5", "-q"});
  EXPECT_EQ(overlapping.code, 4);
  EXPECT_THAT(overlapping.errors, HasSubstr("particles 3 and 7, image (0, 0, 0)"));
}

// Spheroids at φ = 0.2: Z of the run and that of the preparation's report are both near that of spheres, 2.4.
TEST(Program, RunsInThreeDimensions) {
  const Folder folder("run_in_three");
  folder.write("p.toml", std::string(small_packing) + "[dynamics]\nduration = 100\n");
  const Outcome outcome = run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const Json summary = Json::parse(outcome.output);
  EXPECT_EQ(summary["overlaps"], 0);
  EXPECT_EQ(summary["frames"], 201);
  EXPECT_GT(summary["collisions"], 1000);
  EXPECT_LT(summary["energy_drift"], 1e-11);
  EXPECT_NEAR(summary["compressibility_factor"].get<double>(), 2.7, 0.4);
  const TrajectoryReader reader(folder / "run.h5");
  EXPECT_EQ(reader.dimension(), 3);
  EXPECT_NEAR(reader.observable("translational_energy").back() +
                  reader.observable("rotational_energy").back(),
              1.5 * 20 + 20, 1e-9);
  EXPECT_EQ(run(folder.path(), {"check", "run.h5", "-q"}).code, 0);
  ASSERT_EQ(run(folder.path(), {"analyze", "run.h5", "-q"}).code, 0);
  EXPECT_THAT(folder.read("run_results/energies.csv"), HasSubstr("translational"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run_results/compressibility_factor.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run_results/structure_factor.csv"));
  EXPECT_EQ(run(folder.path(), {"report", "run.h5", "-q"}).code, 0);
}

constexpr const char* soft_system =
    "[system]\nparticles = 60\npacking_fraction = 0.3\n[[species]]\naspect_ratio = 1\n"
    "[[prepare.stage]]\nmethod = \"insert\"\n[dynamics]\nduration = 20\nequilibration = 0\n"
    "[dynamics.contact]\nlaw = \"linear_dashpot\"\nstiffness = \"1e5 N/m\"\ndamping = \"100 "
    "kg/s\"\n";

// Damped disks, close to one another after contact: the file says which, and the check knows.
TEST(Program, RunsSoftParticles) {
  const Folder folder("soft");
  checked(setenv("XDG_CACHE_HOME", folder.path().c_str(), 1), "setenv");
  folder.write("p.toml", soft_system);
  const Outcome outcome = run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const Json summary = Json::parse(outcome.output);
  EXPECT_EQ(summary["overlaps"], 0);
  EXPECT_GT(summary["collisions"], 100);
  EXPECT_GT(summary["early_releases"], 0);
  EXPECT_EQ(summary["early_releases_per_collision"],
            summary["early_releases"].get<double>() / summary["collisions"].get<double>());
  EXPECT_GT(summary["dissipated_energy"], 1);
  EXPECT_LT(summary["energy_drift"], 1e-11);
  const Outcome checked = run(folder.path(), {"check", "run.h5", "-q", "--json"});
  ASSERT_EQ(checked.code, 0) << checked.errors;
  EXPECT_GT(Json::parse(checked.output)["close_pairs"], 0);
  Configuration2 close;
  const TrajectoryReader reader(folder / "run.h5");
  for (std::uint64_t k = 0; k < reader.frames() && close.close_pairs.empty(); ++k)
    close = reader.read(k);
  ASSERT_FALSE(close.close_pairs.empty());
  write_state(folder / "close.h5", close, Provenance{});
  const auto from_close = [&](const std::string& output) {
    return std::vector<std::string>{
        "run", "p.toml", "-o", output, "--from", "close.h5", "-q", "--set", "dynamics.duration=1"};
  };
  EXPECT_EQ(run(folder.path(), from_close("on.h5")).code, 0);
  // In closed form, with m_eff = 2.3876 kg: β = γ/(2 m_eff), ω = √(k/m_eff − β²),
  // ω τ = π − atan(2βω/(ω² − β²)), exp(−β τ).
  const Outcome plan = run(folder.path(), {"run", "p.toml", "-o", "new.h5", "--dry-run"});
  EXPECT_THAT(plan.output,
              HasSubstr("linear_dashpot; head-on at 2 m/s it lasts 0.0144 s and leaves 0.7393"));
  EXPECT_THAT(plan.output, HasSubstr("time 0.05 s"));
  // For hard particles it is no state.
  std::string hard = soft_system;
  folder.write("p.toml", hard.substr(0, hard.find("[dynamics.contact]")));
  expect_refusal(run(folder.path(), from_close("hard.h5")), 4, "overlapping pair(s)");
}

TEST(Program, SaysWhatThreeDimensionsDoNotHave) {
  const Folder folder("three_dimensions");
  folder.write("p.toml", small_packing);
  ASSERT_EQ(run(folder.path(), {"prepare", "p.toml", "-o", "state.h5", "-q"}).code, 0);
  folder.write("flat.toml", small_system);
  expect_refusal(run(folder.path(), {"run", "flat.toml", "-o", "a.h5", "--from", "state.h5", "-q",
                                     "--set", "system.dimension=2"}),
                 2, "key 'system.dimension' is 2, but that of the state is 3 (state.h5)");
}

// Without [dynamics] the jobs of a sweep are packings; with it, runs.
TEST(Program, ASweepOfThreeDimensions) {
  const Folder folder("sweep_of_packings");
  folder.write("p.toml", small_packing + "[sweep.grid]\n\"system.seed\" = [1, 2]\n");
  const auto summary_of = [&folder](const std::string& sweep, std::vector<std::string> more) {
    more.insert(more.begin(), {"sweep", "p.toml", "-o", sweep, "--json", "-q"});
    const Outcome outcome = run(folder.path(), more);
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    return Json::parse(outcome.output);
  };
  const Json packings = summary_of("packings", {});
  for (const Json& job : packings["jobs"]) {
    expect_keys(job["prepare"], {"packing_fraction", "orientation_ratio", "reduced_pressure",
                                 "collisions", "wall_seconds"});
    EXPECT_EQ(job["analyze"]["orientation_ratio"], job["prepare"]["orientation_ratio"]);
    EXPECT_FALSE(job.contains("run"));
  }
  EXPECT_EQ(packings["seeds"][0]["seeds"], 2);
  ASSERT_EQ(run(folder.path(), {"analyze", "packings", "-q"}).code, 0);
  const Results results = read_results(folder / "packings/results.h5");
  EXPECT_EQ(results.find("runs")->find("reduced_pressure")->value[1],
            packings["jobs"][1]["prepare"]["reduced_pressure"]);
  EXPECT_EQ(results.find("seeds")->rows(), 1u);
  EXPECT_EQ(run(folder.path(), {"analyze", "packings/seed-1", "-o", "a.h5", "-q"}).code, 0);

  const Json runs = summary_of("runs", {"--set", "dynamics.duration=1"});
  for (const Json& job : runs["jobs"]) {
    EXPECT_EQ(job["run"]["overlaps"], 0);
    EXPECT_NEAR(job["run"]["packing_fraction"], 0.2, 1e-12);
    EXPECT_TRUE(job["analyze"].contains("packing_fraction"));
  }
}

// What only the runs know stands beside the averages of the analysis.
TEST(Program, ASweepAveragesTheExceptionsOfSoftParticles) {
  const Folder folder("soft_sweep");
  checked(setenv("XDG_CACHE_HOME", folder.path().c_str(), 1), "setenv");
  folder.write("p.toml", soft_system + std::string("[sweep.grid]\n\"system.seed\" = [1, 2]\n"));
  const Outcome sweep = run(folder.path(), {"sweep", "p.toml", "-o", "sweep", "--json", "-q"});
  ASSERT_EQ(sweep.code, 0) << sweep.errors;
  const Json jobs = Json::parse(sweep.output)["jobs"];
  ASSERT_EQ(run(folder.path(), {"analyze", "sweep", "-q"}).code, 0);
  const Results results = read_results(folder / "sweep/results.h5");
  for (const char* name : {"early_releases_per_collision", "blocked_rotations_per_collision"}) {
    const double first = jobs[0]["run"][name], second = jobs[1]["run"][name];
    EXPECT_THAT(results.find("runs")->find(name)->value, testing::ElementsAre(first, second));
    EXPECT_DOUBLE_EQ(results.find("seeds")->find(name)->value[0], (first + second) / 2);
  }
  const Outcome status = run(folder.path(), {"sweep", "p.toml", "-o", "sweep", "--status"});
  EXPECT_THAT(status.output, testing::ContainsRegex("seeds .* early +blocked +seconds\n"));
}

// Two particles on top of each other: both ways to look must see it.
TEST(Program, AnOverlapExitsWithFourUnlessItIsToBeCorrected) {
  const Folder folder("overlap");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"prepare", "p.toml", "-o", "state.h5", "-q"}).code, 0);
  Configuration2 state = read_state(folder / "state.h5");
  state.position[7] = state.position[3] + Vec2(0.1, 0.05);
  state.box.wrap(state.position[7], state.image[7]);
  write_state(folder / "overlap.h5", state, Provenance{});

  const Outcome checked = run(folder.path(), {"check", "overlap.h5", "-q"});
  EXPECT_EQ(checked.code, 4);
  EXPECT_THAT(checked.errors, HasSubstr("particles 3 and 7"));
  expect_refusal(run(folder.path(), {"run", "p.toml", "-o", "a.h5", "--from", "overlap.h5", "-q"}),
                 4, "overlapping pair(s)");
  const Outcome corrected =
      run(folder.path(), {"run", "p.toml", "-o", "b.h5", "--from", "overlap.h5", "-q", "--json",
                          "--set", "dynamics.on_overlap=correct"});
  ASSERT_EQ(corrected.code, 0) << corrected.errors;
  EXPECT_GT(Json::parse(corrected.output)["correction_moves"], 0);
}

// However slow the machine, one block is done before the control is asked.
TEST(Program, TheWallTimeBudgetStopsCleanly) {
  const Folder folder("wall_time");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"prepare", "p.toml", "-o", "state.h5", "-q"}).code, 0);
  const std::vector<std::string> arguments = {"run",         "p.toml",
                                              "-o",          "run.h5",
                                              "--from",      "state.h5",
                                              "--wall-time", "0.1",
                                              "--set",       "dynamics.duration=1e6",
                                              "--set",       "output.samples.interval=1e5"};
  const Outcome stopped = run(folder.path(), arguments);
  EXPECT_EQ(stopped.code, 5);
  EXPECT_THAT(stopped.errors, HasSubstr("the same command continues"));
  const Outcome continued = run(folder.path(), arguments);
  EXPECT_EQ(continued.code, 5);
  EXPECT_THAT(continued.errors, HasSubstr("continuing at time"));
}

TEST(Program, ASweepWorksOffItsJobsAndContinues) {
  const Folder folder("sweep");
  folder.write("p.toml", small_system + "[sweep.grid]\n\"system.packing_fraction\" = [0.3, 0.4]\n");
  const std::vector<std::string> sweep = {"sweep", "p.toml", "-o", "sweep", "-j", "2", "-q"};
  std::vector<std::string> status = {"sweep", "p.toml", "-o", "sweep", "--status", "--json"};
  EXPECT_EQ(Json::parse(run(folder.path(), status).output)["jobs"][0]["stage"], "waiting");
  ASSERT_EQ(run(folder.path(), sweep).code, 0);
  const Json jobs = Json::parse(run(folder.path(), status).output)["jobs"];
  ASSERT_EQ(jobs.size(), 2u);
  for (const Json& job : jobs) {
    EXPECT_EQ(job["stage"], "done");
    EXPECT_EQ(job["run"]["overlaps"], 0);
    EXPECT_NEAR(job["run"]["packing_fraction"], job["values"]["system.packing_fraction"], 1e-12);
  }
  const auto file = folder / "sweep/packing_fraction-0.3/run.h5";
  const auto written = std::filesystem::last_write_time(file);
  EXPECT_EQ(run(folder.path(), sweep).code, 0);
  EXPECT_EQ(std::filesystem::last_write_time(file), written);
  EXPECT_EQ(run(folder.path(), {"analyze", "sweep", "-q"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "sweep/results/runs.csv"));
  EXPECT_EQ(run(folder.path(), {"report", "sweep", "-q"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "sweep/report.html"));
  std::vector<std::string> other = sweep;
  other.insert(other.end(), {"--set", "dynamics.duration=9"});
  expect_refusal(run(folder.path(), other), 2,
                 "was begun with dynamics.duration = 10.0, but now it is 9.0");
}

TEST(Program, AFailedJobDoesNotStopTheOthers) {
  const Folder folder("failed_job");
  // No square lattice of ellipses of aspect ratio 6 along x is as dense as 0.85.
  folder.write("p.toml", small_system +
                             "[[species]]\naspect_ratio = 6\n[[prepare.stage]]\n"
                             "method = \"lattice\"\narrangement = \"square\"\n"
                             "[sweep.grid]\n\"system.packing_fraction\" = [0.85, 0.1]\n");
  const Outcome outcome = run(folder.path(), {"sweep", "p.toml", "-o", "sweep"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.errors, AllOf(HasSubstr("packing_fraction-0.85: failed with exit code 2"),
                                    HasSubstr("packing_fraction-0.1: done")));
}

const std::string three_seeds = small_system + "[sweep.grid]\n\"system.seed\" = [1, 2, 3]\n";

TEST(Program, AJobOfASweepIsWorkedOffAlone) {
  const Folder folder("one_job");
  folder.write("p.toml", three_seeds);
  const std::vector<std::string> whole = {"sweep", "p.toml", "-o", "whole", "-q"};
  ASSERT_EQ(run(folder.path(), whole).code, 0);
  const auto job = [](const std::string& id) {
    return std::vector<std::string>{"sweep", "p.toml", "-o", "parts", "--job", id, "--json", "-q"};
  };
  const Outcome second = run(folder.path(), job("seed-2"));
  ASSERT_EQ(second.code, 0) << second.errors;
  EXPECT_EQ(Json::parse(second.output)["jobs"].size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(folder / "parts/seed-1"));
  EXPECT_THAT(differing_datasets(folder / "whole/seed-2/run.h5", folder / "parts/seed-2/run.h5"),
              testing::IsEmpty());
  expect_refusal(run(folder.path(), job("seed-4")), 2,
                 "no job of the sweep has the name 'seed-4'; its jobs: seed-1, seed-2, seed-3");
}

// Two processes given the same job wait for who holds its folder. Then one works, and the other finds the job
// done. One that is given the whole sweep meanwhile is refused.
TEST(Program, AJobIsWorkedOffOnceHoweverManyProcessesGetIt) {
  const Folder folder("same_job");
  folder.write("p.toml", three_seeds);
  std::filesystem::create_directories(folder / "sweep/seed-1");
  const auto start = [&](const std::string& own_folder, std::vector<std::string> more) {
    std::filesystem::create_directory(folder / own_folder);
    std::vector<std::string> words = {"sweep", "../p.toml", "-o", "../sweep"};
    words.insert(words.end(), more.begin(), more.end());
    return std::async(std::launch::async,
                      [&folder, own_folder, words] { return run(folder / own_folder, words); });
  };
  // Not a FolderLock, which the processes to be started would inherit.
  const int held = checked(
      open((folder / "sweep/seed-1/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666), "open");
  checked(flock(held, LOCK_EX), "flock");
  auto first = start("a", {"--job", "seed-1"}), second = start("b", {"--job", "seed-1"});
  for (const char* errors : {"a/standard_error", "b/standard_error"})
    while (folder.read(errors).find("waiting for another process") == std::string::npos)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  expect_refusal(start("c", {"-q"}).get(), 2, "another process works on this sweep");
  checked(close(held), "close");
  int worked = 0, found_done = 0;
  for (const Outcome& outcome : {first.get(), second.get()}) {
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    const bool found = outcome.errors.find("1 of 1 jobs are done already") != std::string::npos;
    ++(found ? found_done : worked);
  }
  EXPECT_EQ(worked, 1);
  EXPECT_EQ(found_done, 1);
}

// A kill may fall between the last act of a preparation and the summary that says it is done.
TEST(Program, AStateWithoutItsSummaryIsMadeAgain) {
  const Folder folder("state_without_summary");
  folder.write("p.toml", small_system);
  const std::vector<std::string> sweep = {"sweep", "p.toml", "-o", "sweep", "-q"};
  ASSERT_EQ(run(folder.path(), sweep).code, 0);
  const auto job = folder / "sweep/job";
  std::filesystem::copy(job, folder / "before", std::filesystem::copy_options::recursive);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "before"))
    if (const auto name = entry.path().filename();
        name != "state.h5" && name != "state.quality.json" && name != "parameters.toml")
      std::filesystem::remove_all(job / name);
  const Outcome again = run(folder.path(), sweep);
  ASSERT_EQ(again.code, 0) << again.errors;
  for (const char* file : {"state.h5", "run.h5"})
    EXPECT_THAT(differing_datasets(folder / "before" / file, job / file), testing::IsEmpty());
}

TEST(Program, AFinishedJobIsAnalyzedAnewWithOtherParametersOfTheAnalysis) {
  const Folder folder("analyzed_anew");
  folder.write("p.toml", small_system);
  std::vector<std::string> sweep = {"sweep", "p.toml", "-o", "sweep", "-q"};
  ASSERT_EQ(run(folder.path(), sweep).code, 0);
  const auto job = folder / "sweep/job";
  std::filesystem::copy(job, folder / "before", std::filesystem::copy_options::recursive);
  sweep.insert(sweep.end(), {"--set", "analysis.longest_lag=0.1"});
  ASSERT_EQ(run(folder.path(), sweep).code, 0);
  EXPECT_THAT(differing_datasets(folder / "before/run.h5", job / "run.h5"), testing::IsEmpty());
  // Fewer time differences.
  const char* table = "results/displacements_all.csv";
  EXPECT_LT(std::filesystem::file_size(job / table),
            std::filesystem::file_size(folder / "before" / table) / 2);
}

}  // namespace
}  // namespace vitrel
