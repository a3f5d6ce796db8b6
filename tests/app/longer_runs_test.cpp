// Runs and sweeps that are made longer: the result is that of a run of the whole length.

#include "core/io/h5md.h"
#include "tests/app/end_to_end.h"

namespace vitrel {
namespace {

using Json = nlohmann::json;

const std::string in_plane =
    "[system]\nparticles = 30\n[dynamics]\nequilibration = 1\n"
    "[output]\nsamples = { spacing = \"linear\", interval = 0.7 }\n";
const std::string brownian =
    "[system]\nparticles = 30\n[dynamics]\nkind = \"brownian\"\nbrownian_step = 0.13\n"
    "equilibration = 1\n[output]\nsamples = { spacing = \"linear\", interval = 0.7 }\n";
const std::string of_spheroids =
    "[system]\ndimension = 3\nparticles = 20\npacking_fraction = 0.2\n[[species]]\n"
    "semi_axes = [1.2, 1.0, 0.7]\n[[prepare.stage]]\nmethod = \"insert\"\n"
    "packing_fraction = 0.2\n[dynamics]\nequilibration = 1\n"
    "[output]\nsamples = { spacing = \"logarithmic\", first = 0.3, per_decade = 7 }\n";
const std::string soft =
    "[system]\ndimension = 3\nparticles = 40\npacking_fraction = 0.1\n[[species]]\n"
    "aspect_ratio = 1\n[[prepare.stage]]\nmethod = \"insert\"\npacking_fraction = 0.1\n"
    "[dynamics]\nequilibration = 0\n[dynamics.contact]\nlaw = \"linear_dashpot\"\n"
    "damping = \"300 kg/s\"\ncoefficients = \"integrated\"\n"
    "[output]\nsamples = { spacing = \"linear\", interval = 0.9 }\n";

std::string command(const std::string& output, const std::string& duration) {
  return "run p.toml -q --set dynamics.duration=" + duration + " -o " + output;
}

struct Scene {
  const char* name;
  std::string parameters;
};

class LongerRun : public testing::TestWithParam<Scene> {};

// Several times, from ends that are no multiple of anything, with a checkpoint at every block or at none.
TEST_P(LongerRun, IsTheRunOfTheWholeLength) {
  const Folder folder(std::string("longer_") + GetParam().name);
  for (const char* interval : {"0", "1000"}) {
    folder.write("p.toml", GetParam().parameters + "checkpoint_interval = " + interval + "\n");
    const std::string whole = std::string("whole") + interval + ".h5";
    const std::string parts = std::string("parts") + interval + ".h5";
    folder.succeed(command(whole, "40"));
    for (const char* duration : {"5.3", "5.3", "11", "11.01", "40"})
      folder.succeed(command(parts, duration));
    folder.expect_same_datasets(whole, parts);
    EXPECT_THAT(TrajectoryReader(folder / parts).provenance().parameters,
                HasSubstr("duration = 40.0"));
    if (fs::exists(folder / (whole + ".correlations.h5")))
      folder.expect_same_datasets(whole + ".correlations.h5", parts + ".correlations.h5");
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, LongerRun,
    testing::Values(Scene{"newtonian", in_plane}, Scene{"brownian", brownian},
                    Scene{"in_space", of_spheroids}, Scene{"soft", soft},
                    Scene{"correlated",
                          in_plane + "correlations = { interval = 0.3, longest_lag = 4 }\n"}),
    [](const auto& scene) { return scene.param.name; });

TEST(LongerRun, KeepsWhatItsBeginningChose) {
  const Folder folder("longer_defaults",
                      "[system]\nparticles = 30\n[dynamics]\nequilibration = 1\n"
                      "[output]\ncorrelations = { interval = 0.5 }\n");
  folder.succeed(command("run.h5", "30"));
  folder.succeed(command("run.h5", "60"));
  const TrajectoryReader reader(folder / "run.h5");
  EXPECT_EQ(reader.frames(), 401u);
  EXPECT_THAT(reader.provenance().parameters,
              AllOf(HasSubstr("interval = 0.15"), HasSubstr("longest_lag = 15.0")));
}

TEST(LongerRun, NothingElseMayChange) {
  const Folder folder("longer_refused", in_plane);
  folder.succeed(command("run.h5", "10"));
  folder.expect_refusals(
      {{command("run.h5", "9"), 2, "begun with dynamics.duration = 10.0, but now it is 9.0"},
       {command("run.h5", "20") + " --set output.samples.interval=0.5", 2,
        "begun with output.samples.interval = 0.7"}});
  EXPECT_THAT(folder.run(command("run.h5", "20") + " --dry-run").output,
              HasSubstr("the checkpoint at "));
  // Without what it would start from it says so, and is left alone.
  const std::string before = folder.read("run.h5");
  fs::remove(folder / "run.h5.checkpoint.previous");
  folder.expect_refusal(command("run.h5", "20"), 3,
                        "run.h5.checkpoint.previous: cannot open the file");
  EXPECT_EQ(folder.read("run.h5"), before);
  folder.succeed(command("run.h5", "10"));
}

TEST(LongerRun, AFinishedSweepGrowsToo) {
  const Folder folder("longer_sweep", in_plane + "[sweep.grid]\n\"system.seed\" = [1, 2]\n");
  const std::string parts = "sweep p.toml -o parts -q --set dynamics.duration=";
  folder.succeed(parts + "10");
  folder.succeed(parts + "25");
  folder.succeed("sweep p.toml -o whole -q --set dynamics.duration=25");
  for (const std::string file : {"/seed-1/run.h5", "/seed-2/run.h5", "/seed-1/results.h5"})
    folder.expect_same_datasets("whole" + file, "parts" + file);
  EXPECT_EQ(Json::parse(folder.read("parts/seed-1/done.json"))["run"]["simulated_time"], 26);
  folder.expect_refusal(parts + "20", 2, "begun with dynamics.duration = 25.0, but now it is 20.0");
}

// A run that is stopped while it equilibrates.
TEST(LongerRun, TheEquilibrationIsCalledSo) {
  const Folder folder("equilibration", in_plane);
  folder.succeed("prepare p.toml -o state.h5 -q");
  const std::string stopped =
      "run p.toml -o run.h5 --from state.h5 --wall-time 1e-6 --set dynamics.duration=10 "
      "--set dynamics.equilibration=1e5";
  ASSERT_EQ(folder.run(stopped + " -q").code, 5);
  const Outcome again = folder.run(stopped);
  EXPECT_EQ(again.code, 5);
  EXPECT_THAT(again.errors, testing::ContainsRegex(
                                "continuing at time [0-9.e+]+ of 100000 of the equilibration"));
}

}  // namespace
}  // namespace vitrel
