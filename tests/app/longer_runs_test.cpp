// Runs and sweeps that are made longer: the result is that of a run of the whole length.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/io/h5md.h"
#include "tests/app/program.h"

namespace vitrel {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing_program::differing_datasets;
using testing_program::expect_refusal;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using testing_program::succeed;
using Json = nlohmann::json;
namespace fs = std::filesystem;

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

std::vector<std::string> command(const std::string& output, const std::string& duration) {
  return {"run", "p.toml", "-o", output, "-q", "--set", "dynamics.duration=" + duration};
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
    succeed(folder, command(whole, "40"));
    for (const char* duration : {"5.3", "5.3", "11", "11.01", "40"})
      succeed(folder, command(parts, duration));
    EXPECT_THAT(differing_datasets(folder / whole, folder / parts), IsEmpty());
    EXPECT_THAT(TrajectoryReader(folder / parts).provenance().parameters,
                HasSubstr("duration = 40.0"));
    if (!fs::exists(folder / (whole + ".correlations.h5"))) continue;
    EXPECT_THAT(differing_datasets(folder / (whole + ".correlations.h5"),
                                   folder / (parts + ".correlations.h5")),
                IsEmpty());
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
  const Folder folder("longer_defaults");
  folder.write("p.toml",
               "[system]\nparticles = 30\n[dynamics]\nequilibration = 1\n"
               "[output]\ncorrelations = { interval = 0.5 }\n");
  succeed(folder, command("run.h5", "30"));
  succeed(folder, command("run.h5", "60"));
  const TrajectoryReader reader(folder / "run.h5");
  EXPECT_EQ(reader.frames(), 401u);
  EXPECT_THAT(reader.provenance().parameters,
              testing::AllOf(HasSubstr("interval = 0.15"), HasSubstr("longest_lag = 15.0")));
}

TEST(LongerRun, NothingElseMayChange) {
  const Folder folder("longer_refused");
  folder.write("p.toml", in_plane);
  succeed(folder, command("run.h5", "10"));
  expect_refusal(run(folder.path(), command("run.h5", "9")), 2,
                 "begun with dynamics.duration = 10.0, but now it is 9.0");
  std::vector<std::string> other = command("run.h5", "20");
  other.insert(other.end(), {"--set", "output.samples.interval=0.5"});
  expect_refusal(run(folder.path(), other), 2, "begun with output.samples.interval = 0.7");
  std::vector<std::string> dry = command("run.h5", "20");
  dry.push_back("--dry-run");
  EXPECT_THAT(run(folder.path(), dry).output, HasSubstr("the checkpoint at "));
  // Without what it would start from it says so, and is left alone.
  const std::string before = folder.read("run.h5");
  fs::remove(folder / "run.h5.checkpoint.previous");
  expect_refusal(run(folder.path(), command("run.h5", "20")), 3,
                 "run.h5.checkpoint.previous: cannot open the file");
  EXPECT_EQ(folder.read("run.h5"), before);
  EXPECT_EQ(run(folder.path(), command("run.h5", "10")).code, 0);
}

TEST(LongerRun, AFinishedSweepGrowsToo) {
  const Folder folder("longer_sweep");
  folder.write("p.toml", in_plane + "[sweep.grid]\n\"system.seed\" = [1, 2]\n");
  const auto sweep = [&](const std::string& name, const std::string& duration) {
    succeed(folder,
            {"sweep", "p.toml", "-o", name, "-q", "--set", "dynamics.duration=" + duration});
  };
  sweep("parts", "10");
  sweep("parts", "25");
  sweep("whole", "25");
  for (const std::string file : {"seed-1/run.h5", "seed-2/run.h5", "seed-1/results.h5"})
    EXPECT_THAT(differing_datasets(folder / ("whole/" + file), folder / ("parts/" + file)),
                IsEmpty())
        << file;
  EXPECT_EQ(Json::parse(folder.read("parts/seed-1/done.json"))["run"]["simulated_time"], 26);
  expect_refusal(
      run(folder.path(), {"sweep", "p.toml", "-o", "parts", "-q", "--set", "dynamics.duration=20"}),
      2, "begun with dynamics.duration = 25.0, but now it is 20.0");
}

// A run that is stopped while it equilibrates.
TEST(LongerRun, TheEquilibrationIsCalledSo) {
  const Folder folder("equilibration");
  folder.write("p.toml", in_plane);
  std::vector<std::string> stopped = command("run.h5", "10");
  stopped.insert(stopped.end(), {"--set", "dynamics.equilibration=1e5", "--wall-time", "1e-6"});
  succeed(folder, {"prepare", "p.toml", "-o", "state.h5", "-q"});
  stopped.insert(stopped.end(), {"--from", "state.h5"});
  ASSERT_EQ(run(folder.path(), stopped).code, 5);
  stopped.erase(std::find(stopped.begin(), stopped.end(), "-q"));
  const Outcome again = run(folder.path(), stopped);
  EXPECT_EQ(again.code, 5);
  EXPECT_THAT(again.errors, testing::ContainsRegex(
                                "continuing at time [0-9.e+]+ of 100000 of the equilibration"));
}

}  // namespace
}  // namespace vitrel
