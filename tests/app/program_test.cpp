// The program from outside: what it prints, writes and returns.

#include <array>
#include <map>
#include <sstream>

#include "analysis/results.h"
#include "core/io/h5md.h"
#include "tests/app/end_to_end.h"
#include "tests/app/systems.h"
#include "tests/support/partial_files.h"

namespace vitrel {
namespace {

using Json = nlohmann::json;

class SmallSystem : public testing::Test {
 protected:
  /// Deletes run.h5, or what lies beside it, with these endings.
  void remove_run(const std::vector<std::string>& endings) const {
    for (const std::string& ending : endings) fs::remove(folder / ("run.h5" + ending));
  }

  const Folder folder{"small_system", small_system};
};

const std::vector<std::string> checkpoints = {".checkpoint", ".checkpoint.previous"};

TEST_F(SmallSystem, PrepareRunCheckAnalyzeAndReport) {
  const Json preparation = folder.summary("prepare p.toml -o state.h5");
  expect_keys(preparation,
              {"packing_fraction", "wall_seconds", "trial_moves", "trial_moves_per_second",
               "acceptance_translation", "acceptance_rotation", "nematic_order", "overlaps"});
  EXPECT_NEAR(preparation["packing_fraction"], 0.5, 1e-12);
  EXPECT_EQ(preparation["overlaps"], 0);

  const Json summary = folder.summary("run p.toml -o run.h5 --from state.h5");
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

  const Json check = folder.summary("check run.h5");
  EXPECT_EQ(check["frames"], 21);
  EXPECT_EQ(check["overlaps"], 0);
  EXPECT_GT(check["smallest_gap"], 0);

  folder.succeed("analyze run.h5 -o results.h5 -q");
  EXPECT_TRUE(fs::exists(folder / "results.h5"));
  for (const char* table : {"displacements_all", "self_scattering_all", "orientation_all",
                            "wave_numbers", "collective_scattering", "susceptibility"})
    EXPECT_TRUE(fs::exists(folder / fmt::format("results/{}.csv", table))) << table;
  folder.succeed("report run.h5 -o page.html -q");
  EXPECT_GT(fs::file_size(folder / "page.html"), 10'000u);
}

// Where the run correlates the states it writes, both analyses average over the same: lags up to 7, which
// have all origins.
TEST(Program, CorrelatesOnTheFly) {
  const Folder folder("correlates",
                      small_system + "correlations = { interval = 0.5, wave_numbers = [2, 3] }\n");
  EXPECT_THAT(folder.succeed("run p.toml -o run.h5 --dry-run"),
              HasSubstr("correlates   every 0.5, into run.h5.correlations.h5"));
  EXPECT_EQ(folder.summary("run p.toml -o run.h5")["correlations"], "run.h5.correlations.h5");
  folder.succeed("analyze run.h5 -o results.h5 -q");
  EXPECT_TRUE(fs::exists(folder / "results/on_the_fly_all.csv"));
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
TEST_F(SmallSystem, ANewRunForgetsTheCorrelationsOfAnEarlierOne) {
  folder.succeed("run p.toml -o run.h5 -q --set output.correlations.interval=0.1");
  ASSERT_TRUE(fs::exists(folder / "run.h5.correlations.h5"));
  remove_run({"", ".checkpoint", ".checkpoint.previous"});
  folder.succeed("run p.toml -o run.h5 -q");
  EXPECT_FALSE(fs::exists(folder / "run.h5.correlations.h5"));
}

TEST_F(SmallSystem, PrepareReportsTheQualityOfTheState) {
  EXPECT_THAT(
      folder.succeed("prepare p.toml -o state.h5"),
      AllOf(HasSubstr("reduced pressure"), HasSubstr("nematic order"), HasSubstr("hexatic order"),
            HasSubstr("displacement time"), HasSubstr("exact check: 0 overlaps")));
  EXPECT_THAT(partial_files(folder.path()), IsEmpty());
  const Json summary = folder.summary("prepare p.toml -o same.h5");
  EXPECT_EQ(summary["quality_report"], "same.quality.json");
  const Json file = Json::parse(folder.read("same.quality.json"));
  EXPECT_EQ(summary["quality"], file);
  expect_keys(file, {"packing_fraction", "reduced_pressure", "nematic_order", "nematic_correlation",
                     "hexatic_order", "overlaps", "smallest_gap", "jamming", "time_correlation"});
  EXPECT_NEAR(file["packing_fraction"], 0.5, 1e-12);
  EXPECT_EQ(file["overlaps"], 0);
  EXPECT_EQ(file["reduced_pressure"]["from"], "sampling");
  EXPECT_EQ(file["time_correlation"]["measured_sweeps"], 800);
  // The seed decides this file, too.
  EXPECT_EQ(file, Json::parse(folder.read("state.quality.json")));

  folder.succeed("report state.h5 -q");
  EXPECT_THAT(folder.read("state.html"),
              AllOf(HasSubstr("reduced pressure"), HasSubstr("30 ellipses, κ = 2 at φ = 0.5")));
}

TEST_F(SmallSystem, AStateIsNotReportedWithoutItsQuality) {
  folder.succeed("prepare p.toml -o state.h5 -q");
  folder.succeed("prepare p.toml -o b.h5 -q --seed 2");
  fs::copy_file(folder / "b.quality.json", folder / "state.quality.json",
                fs::copy_options::overwrite_existing);
  folder.expect_refusal("report state.h5 -q", 3,
                        "state.quality.json: is the quality report of another state");
  fs::remove(folder / "state.quality.json");
  folder.expect_refusal("report state.h5 -q", 3, "state.quality.json: is missing");
  EXPECT_FALSE(fs::exists(folder / "state.html"));
}

TEST_F(SmallSystem, ACompleteRunIsLeftAlone) {
  folder.succeed("run p.toml -o run.h5 -q");
  const auto written = fs::last_write_time(folder / "run.h5");
  const Outcome again = folder.run("run p.toml -o run.h5");
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.errors, HasSubstr("complete already"));
  EXPECT_EQ(fs::last_write_time(folder / "run.h5"), written);
}

TEST_F(SmallSystem, ARunIsNotContinuedWithOtherParameters) {
  folder.succeed("run p.toml -o run.h5 -q");
  folder.expect_refusal("run p.toml -o run.h5 -q --seed 2", 2,
                        "begun with system.seed = 1, but now it is 2");
  folder.expect_refusal("prepare p.toml -o run.h5 -q", 2, "exists already");
  remove_run(checkpoints);
  folder.expect_refusal("run p.toml -o run.h5 -q", 2, "has no checkpoint");
}

TEST_F(SmallSystem, AStateMustFitTheParameters) {
  folder.succeed("prepare p.toml -o state.h5 -q");
  const std::string start = "run p.toml -o run.h5 --from state.h5 ";
  folder.expect_refusals(
      {{start + "-q --set system.particles=31", 2,
        "key 'system.particles' is 31, but that of the state is 30 (state.h5)"},
       {start + "-q --set system.packing_fraction=0.4", 2,
        "key 'system.packing_fraction' is 0.4, but that of the state is"},
       {start + "-q --set dynamics.initial_velocities=keep", 2, "is at rest"},
       // Before it does anything, the plan refuses the same.
       {start + "--dry-run --set system.particles=31", 2, "key 'system.particles' is 31"},
       {start + "--dry-run --set dynamics.initial_velocities=keep", 2, "is at rest"},
       {"run p.toml -o state.h5 --dry-run", 2,
        "state.h5: exists, but has no checkpoint beside it"}});
}

// What a run records is what ran, whatever the parameter file says or leaves out.
TEST(Program, TheSpeciesOfAStateWin) {
  const Folder folder("species_of_state");
  folder.write("k14.toml", small_system + "[[species]]\naspect_ratio = 1.4\n");
  folder.succeed("prepare k14.toml -o k14.h5 -q");
  folder.write("none.toml", small_system);
  folder.write("other.toml", small_system + "[[species]]\naspect_ratio = 2.0\n");
  const std::string contradiction =
      "other.toml:9:16: key 'species.0.aspect_ratio' is 2, but particle 0 has 1.4";
  const std::string contradictory = "run other.toml -o run.h5 --from k14.h5 ";
  for (const char* how : {"--quiet", "--dry-run"})
    folder.expect_refusal(contradictory + how, 2, contradiction);
  EXPECT_FALSE(fs::exists(folder / "run.h5.checkpoint"));
  const std::string from_none = "run none.toml -o run.h5 --from k14.h5";
  const Outcome ran = folder.run(from_none);
  ASSERT_EQ(ran.code, 0) << ran.errors;
  EXPECT_THAT(ran.errors, HasSubstr("species as in k14.h5"));
  EXPECT_THAT(TrajectoryReader(folder / "run.h5").provenance().parameters,
              HasSubstr("aspect_ratio = 1.4\n"));
  // The same command finds it complete, also without the state.
  fs::remove(folder / "k14.h5");
  folder.succeed(from_none);
  folder.expect_refusal(contradictory + "-q", 2, contradiction);
}

TEST_F(SmallSystem, TheEnergyMayBeSplitAndSpeciesHeated) {
  const auto energies = [&](const std::string& output, const std::string& settings) {
    folder.succeed("run p.toml -q --set dynamics.equilibration=0 " + settings + " -o " + output);
    const Mechanics<2> sums = mechanics(TrajectoryReader(folder / output).read<2>(0));
    return std::array{sums.translational_energy, sums.rotational_energy};
  };
  // 30 ellipses: 30 kT and 15 kT.
  const auto split =
      energies("split.h5", "--set 'dynamics.initial_velocities={ translation = 0.7 }'");
  EXPECT_NEAR(split[0], 0.7 * 45, 1e-12);
  EXPECT_NEAR(split[1], 0.3 * 45, 1e-12);
  const auto hot =
      energies("hot.h5", "--set species.0.aspect_ratio=2 --set species.0.initial_temperature=3");
  EXPECT_NEAR(hot[0], 90, 1e-11);
  EXPECT_NEAR(hot[1], 45, 1e-11);
  folder.expect_refusal(
      "run p.toml -o a.h5 --set 'dynamics.initial_velocities={ translation = 1.5 }'", 2,
      "key 'dynamics.initial_velocities.translation' is 1.5");
}

/// Starts from state.h5 and is stopped after the first block, however slow the machine.
std::string stopped_run(const std::string& setting) {
  return "run p.toml -o run.h5 -q --from state.h5 --wall-time 0.001 --set dynamics.duration=1e6 "
         "--set output.samples.interval=1e5 --set " +
         setting;
}

constexpr const char* whole_run = "run p.toml -o run.h5 -q";

TEST_F(SmallSystem, ACheckpointWithoutItsTrajectoryIsRefusedAndKept) {
  folder.succeed("prepare p.toml -o state.h5 -q");
  const auto expect_refusal = [&](const std::string& again) {
    fs::remove(folder / "run.h5");
    const std::string before = folder.read("run.h5.checkpoint");
    folder.expect_refusal(
        again, 3, "run.h5: is missing, but run.h5.checkpoint is there, the checkpoint of the run");
    EXPECT_FALSE(fs::exists(folder / "run.h5"));
    EXPECT_EQ(folder.read("run.h5.checkpoint"), before);
  };
  // The frame of time 0 is in the first block.
  ASSERT_EQ(folder.run(stopped_run("dynamics.equilibration=0")).code, 5);
  expect_refusal(stopped_run("dynamics.equilibration=0"));
  remove_run(checkpoints);
  folder.succeed(whole_run);
  expect_refusal(whole_run);
  expect_refusal("run p.toml -o run.h5 --dry-run");
  remove_run(checkpoints);
  folder.succeed(whole_run);
}

TEST_F(SmallSystem, ACheckpointBesideAnotherTrajectoryIsRefused) {
  const auto expect_refusal = [&](const std::string& change, const std::string& why) {
    folder.succeed("run p.toml -o other.h5 -q " + change);
    fs::rename(folder / "other.h5", folder / "run.h5");
    fs::remove(folder / "other.h5.checkpoint");
    fs::remove(folder / "other.h5.checkpoint.previous");
    const std::string before = folder.read("run.h5");
    folder.expect_refusal(whole_run, 3, why);
    EXPECT_EQ(folder.read("run.h5"), before);
  };
  folder.succeed(whole_run);
  expect_refusal("--seed 77", "run.h5: was written with system.seed = 77, not 1, but");
  expect_refusal("--set dynamics.duration=0.5", " frames instead of ");
}

// The first checkpoint is saved before the trajectory is made.
TEST_F(SmallSystem, ACheckpointBeforeTheFirstFrameNeedsNoTrajectory) {
  folder.succeed("prepare p.toml -o state.h5 -q");
  const std::string equilibrating = stopped_run("dynamics.equilibration=1e6");
  ASSERT_EQ(folder.run(equilibrating).code, 5);
  ASSERT_TRUE(fs::remove(folder / "run.h5"));
  const Outcome continued = folder.run(equilibrating);
  EXPECT_EQ(continued.code, 5) << continued.errors;
  EXPECT_TRUE(fs::exists(folder / "run.h5"));
}

TEST_F(SmallSystem, ADryRunWritesNothing) {
  EXPECT_THAT(folder.succeed("run p.toml -o run.h5 --dry-run"),
              AllOf(HasSubstr("30 particles"), HasSubstr("21 frames")));
  EXPECT_FALSE(fs::exists(folder / "run.h5"));
  EXPECT_FALSE(fs::exists(folder / "run.h5.checkpoint"));
}

TEST(Program, EveryKindOfBadParameterFileExitsWithTwo) {
  const Folder folder("bad_files");
  for (const auto& [text, part] :
       {std::pair("[system\n", "vitrel run: p.toml:1:8: not valid TOML"),
        {"[system]\nparticels = 3\n",
         "p.toml:2:1: key 'system.particels' is unknown; did you mean 'particles'?"},
        {"[system]\nparticles = \"a\"\n", "p.toml:2:13: key 'system.particles' must be an integer"},
        {"[system]\nparticles = -3\n",
         "p.toml:2:13: key 'system.particles' is -3, but must be positive"}}) {
    folder.write("p.toml", text);
    folder.expect_refusal("run p.toml -o run.h5", 2, part);
  }
  EXPECT_FALSE(fs::exists(folder / "run.h5"));
  folder.write("p.toml", small_system);
  folder.expect_refusal("run p.toml -o run.h5 --set dynamics.durtion=1", 2,
                        "--set dynamics.durtion=1: key 'dynamics.durtion' is unknown");
}

TEST(Program, MistakesOnTheCommandLineExitWithTwo) {
  const Folder folder("command_line");
  for (const char* command : {"", "frobnicate", "run", "check --frames", "params", "params check",
                              "params run --reference", "params --python --reference",
                              "run p.toml -o r.h5 --wall-time -1", "sweep p.toml -o s -j 0"})
    folder.expect_refusal(command, 2, "vitrel");
}

TEST(Program, HelpFitsATerminalAndNamesTheExitCodesThatOccur) {
  const Folder folder("help");
  const std::map<std::string, std::vector<int>> codes = {
      {"prepare", {0, 2, 3, 4, 5}}, {"run", {0, 2, 3, 4, 5}}, {"check", {0, 2, 3, 4, 5}},
      {"analyze", {0, 2, 3, 5}},    {"report", {0, 2, 3, 5}}, {"sweep", {0, 2, 3, 4, 5}},
      {"export", {0, 2, 3, 5}},     {"params", {0, 2, 3}},    {"picture", {0, 2, 3, 5}}};
  for (const auto& [command, expected] : codes) {
    const std::string help = folder.succeed(command + " --help");
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
    std::string footer = help.substr(help.find("Exit codes: "));
    std::replace(footer.begin(), footer.end(), '\n', ' ');
    std::vector<int> named;
    for (const char digit : std::string("0123456789"))
      if (footer.find(std::string{' ', digit, ' '}) != std::string::npos)
        named.push_back(digit - '0');
    EXPECT_EQ(named, expected) << command;
  }
}

// Whatever the analysis finds wrong comes with the file.
TEST_F(SmallSystem, AWaveNumberTooSmallForTheBoxIsRefusedNamingTheFile) {
  folder.succeed("run p.toml -o run.h5 -q");
  folder.expect_refusal("analyze run.h5 -q --set analysis.wave_numbers=[1e-3]", 2,
                        "run.h5: the wave number 0.001000 is too small for the box");
}

TEST_F(SmallSystem, FilesThatCannotBeReadOrWrittenExitWithThree) {
  folder.expect_refusals(
      {{"run absent.toml -o run.h5", 3, "absent.toml: "},
       // No process, whatever its rights, can make a file in a folder that is a file.
       {"run p.toml -o p.toml/run.h5 -q", 3, "p.toml/run.h5"},
       {"prepare p.toml -o p.toml/run.h5 -q", 3, "p.toml/run.h5"},
       {"run p.toml -o absent/run.h5 -q", 3, "absent/run.h5"},
       {"prepare p.toml -o absent/run.h5 -q", 3, "absent/run.h5"},
       {"sweep p.toml -o p.toml/sweep -q", 3, "p.toml/sweep"},
       {"check p.toml -q", 3, "p.toml: "},
       {"check absent.h5 -q", 3, "absent.h5: "}});
}

TEST_F(SmallSystem, ATruncatedFileExitsWithThree) {
  folder.succeed("run p.toml -o run.h5 -q");
  fs::resize_file(folder / "run.h5", fs::file_size(folder / "run.h5") / 2);
  for (const std::string command : {"check", "analyze", "report"})
    folder.expect_refusal(command + " run.h5 -q", 3, "run.h5");
  for (const std::string& checkpoint : checkpoints)
    if (fs::exists(folder / ("run.h5" + checkpoint)))
      fs::resize_file(folder / ("run.h5" + checkpoint), 100);
  folder.expect_refusal("run p.toml -o run.h5 -q", 3, "run.h5.checkpoint");
}

}  // namespace
}  // namespace vitrel
