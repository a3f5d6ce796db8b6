// What `--dry-run` expects of a preparation and a run, against both: by events and sweeps, not by the clock.

#include <regex>

#include "tests/app/end_to_end.h"

namespace vitrel {
namespace {

using Json = nlohmann::json;

struct Scene {
  const char* name;
  std::string system, species, dynamics;
};

class RunCost : public testing::TestWithParam<Scene> {};

std::string parameters(const Scene& scene) {
  return "[system]\n" + scene.system + "[[species]]\n" + scene.species +
         "[[prepare.stage]]\nmethod = \"insert\"\n[[prepare.stage]]\nmethod = \"swell\"\n"
         "[dynamics]\nequilibration = 1\n" +
         scene.dynamics + "[output]\nsamples.interval = 0.25\n";
}

/// Events, seconds, megabytes of memory and on disk.
std::vector<double> expected(const std::string& plan) {
  const std::regex line(
      "expects +(\\S+) events, (\\S+) s after the preparation, (\\S+) MB of memory, (\\S+) MB on "
      "disk\n");
  std::smatch found;
  std::vector<double> numbers;
  if (!std::regex_search(plan, found, line)) return {0, 0, 0, 0};
  for (std::size_t k = 1; k < found.size(); ++k) numbers.push_back(std::stod(found[k]));
  return numbers;
}

void expect_within_two(double expected, double found, const char* what) {
  EXPECT_GT(expected, found / 2) << what;
  EXPECT_LT(expected, found * 2) << what;
}

TEST_P(RunCost, IsGoodToAFactorOfTwo) {
  const Folder folder(std::string("cost_") + GetParam().name, parameters(GetParam()));
  const std::vector<double> cost = expected(folder.succeed("run p.toml -o run.h5 --dry-run"));
  const Outcome ran = folder.run("run p.toml -o run.h5 --json -q");
  ASSERT_EQ(ran.code, 0) << ran.errors;
  expect_within_two(cost[0], Json::parse(ran.output)["events"], "events");
  EXPECT_GT(cost[1], 0);
#ifndef __SANITIZE_ADDRESS__
  expect_within_two(cost[2], ran.memory_bytes / 1e6, "memory");
#endif
  const auto size = static_cast<double>(fs::file_size(folder / "run.h5"));
  expect_within_two(cost[3], size / 1e6, "disk");
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, RunCost,
    testing::Values(
        Scene{"ellipses", "particles = 400\npacking_fraction = 0.6\n", "aspect_ratio = 2\n",
              "duration = 10\n"},
        Scene{"gas_of_disks", "particles = 20000\npacking_fraction = 0.1\n", "aspect_ratio = 1\n",
              "duration = 2\n"},
        Scene{"spheres", "dimension = 3\nparticles = 4000\npacking_fraction = 0.4\n",
              "aspect_ratio = 1\n", "duration = 3\n"},
        Scene{"ellipsoids", "dimension = 3\nparticles = 300\npacking_fraction = 0.35\n",
              "semi_axes = [1.5, 1, 0.6]\n", "duration = 5\n"},
        Scene{"brownian_mixture", "particles = 300\npacking_fraction = 0.65\n",
              "name = \"A\"\naspect_ratio = 3\nfraction = 0.5\n[[species]]\nname = \"B\"\n"
              "aspect_ratio = 1.5\nsize = 0.7\nfraction = 0.5\n",
              "kind = \"brownian\"\nduration = 10\n"}),
    [](const auto& scene) { return scene.param.name; });

/// What a plan expects of a quantity of its last stage, "…, 1.9e+05 events, 1e+03 sweeps, 0.2 s".
double expected_of_stage(const std::string& plan, const std::string& quantity) {
  const std::regex line("stage .*, (\\S+) " + quantity + ",.*\nprepares in +(\\S+) s\n");
  std::smatch found;
  return std::regex_search(plan, found, line) ? std::stod(found[1]) : 0;
}

void expect_within_three(double expected, double found, const char* what) {
  EXPECT_GE(expected, found / 3) << what;
  EXPECT_LE(expected, found * 3) << what;
}

class PreparationPlan : public testing::TestWithParam<Scene> {};

TEST_P(PreparationPlan, IsGoodToAFactorOfThree) {
  const Folder folder(std::string("plan_") + GetParam().name,
                      "[system]\n" + GetParam().system + "[[species]]\n" + GetParam().species +
                          "[prepare]\nquality_sweeps = 0\n[[prepare.stage]]\n"
                          "[[prepare.stage]]\n" +
                          GetParam().dynamics);
  const std::string plan = folder.succeed("prepare p.toml -o s.h5 --dry-run");
  EXPECT_FALSE(fs::exists(folder / "s.h5"));
  const std::string stages = plan.substr(plan.find("stage"));
  EXPECT_THAT(folder.run("run p.toml -o r.h5 --dry-run").output,
              HasSubstr(stages.substr(0, stages.find("writes"))));
  const Json stage = folder.summary("prepare p.toml -o s.h5")["stages"][1];
  constexpr double events_per_collision = 1.7;
  expect_within_three(expected_of_stage(plan, "events"),
                      events_per_collision * stage["collisions"].get<double>(), "events");
  expect_within_three(expected_of_stage(plan, "sweeps"), stage["sweeps"], "sweeps");
}

constexpr const char* grow_to_pressure =
    "method = \"grow\"\nreduced_pressure = 1e5\ngrowth_rate = 0.01\n";

INSTANTIATE_TEST_SUITE_P(
    Scenes, PreparationPlan,
    testing::Values(
        Scene{"ellipses", "particles = 400\npacking_fraction = 0.7\n", "aspect_ratio = 2\n",
              "method = \"grow\"\ngrowth_rate = 0.01\n"},
        Scene{"small_spheres", "dimension = 3\nparticles = 500\npacking_fraction = 0.4\n",
              "aspect_ratio = 1\nsize = 0.1\n", "method = \"grow\"\ngrowth_rate = 0.01\n"},
        Scene{"jammed_ellipses", "particles = 200\n", "aspect_ratio = 2\n", grow_to_pressure},
        Scene{"swollen_disks", "particles = 1000\npacking_fraction = 0.7\n", "aspect_ratio = 1\n",
              "method = \"swell\"\n"},
        Scene{"swollen_spheroids", "dimension = 3\nparticles = 300\npacking_fraction = 0.4\n",
              "aspect_ratio = 2\n", "method = \"swell\"\n"},
        Scene{"by_both", "particles = 100\n", "aspect_ratio = 2\n",
              "method = \"hybrid\"\nreduced_pressure = 1e5\nstretch_sweeps = 10\n"}),
    [](const auto& scene) { return scene.param.name; });

TEST(PreparationPlan, NamesStagesThatTakeAsLongAsTheyTake) {
  const Folder folder(
      "plan_unforeseen",
      "[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"swell\"\n[[prepare.stage]]\n"
      "method = \"sample\"\ndecorrelations = 10\n");
  EXPECT_THAT(folder.run("prepare p.toml -o s.h5 --dry-run").output,
              HasSubstr(", as many sweeps as it takes\nprepares in  more than "));
}

TEST(RunCostOfTooMuch, IsAWarning) {
  const Folder folder("cost_of_too_much",
                      "[system]\nparticles = 100000000\n[dynamics]\nduration = 1000\n");
  const std::string plan = folder.succeed("run p.toml -o run.h5 --dry-run");
  for (const std::string what : {"memory", "disk"})
    EXPECT_THAT(plan,
                testing::ContainsRegex("warning +needs .* MB of " + what + ", but there are"));
}

}  // namespace
}  // namespace vitrel
