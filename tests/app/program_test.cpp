// The program from outside: what it prints, writes and returns.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/results.h"
#include "core/io/h5md.h"
#include "tests/app/program.h"
#include "tests/app/systems.h"
#include "tests/support/partial_files.h"

namespace vitrel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing_program::expect_keys;
using testing_program::expect_refusal;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using testing_program::small_system;
using Json = nlohmann::json;

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

}  // namespace
}  // namespace vitrel
