// What `vitrel run --dry-run` expects of a run, against the run: by events, not by the clock.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/app/program.h"

namespace vitrel {
namespace {

using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
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
  const Folder folder(std::string("cost_") + GetParam().name);
  folder.write("p.toml", parameters(GetParam()));
  const Outcome plan = run(folder.path(), {"run", "p.toml", "-o", "run.h5", "--dry-run"});
  ASSERT_EQ(plan.code, 0) << plan.errors;
  const std::vector<double> cost = expected(plan.output);
  const Outcome ran = run(folder.path(), {"run", "p.toml", "-o", "run.h5", "--json", "-q"});
  ASSERT_EQ(ran.code, 0) << ran.errors;
  expect_within_two(cost[0], Json::parse(ran.output)["events"], "events");
  EXPECT_GT(cost[1], 0);
#ifndef __SANITIZE_ADDRESS__
  expect_within_two(cost[2], ran.memory_bytes / 1e6, "memory");
#endif
  const auto size = static_cast<double>(std::filesystem::file_size(folder / "run.h5"));
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

TEST(RunCostOfTooMuch, IsAWarning) {
  const Folder folder("cost_of_too_much");
  folder.write("p.toml", "[system]\nparticles = 100000000\n[dynamics]\nduration = 1000\n");
  const Outcome plan = run(folder.path(), {"run", "p.toml", "-o", "run.h5", "--dry-run"});
  EXPECT_EQ(plan.code, 0) << plan.errors;
  EXPECT_THAT(plan.output, testing::ContainsRegex("warning +needs .* MB of memory, but there are"));
  EXPECT_THAT(plan.output, testing::ContainsRegex("warning +needs .* MB of disk, but there are"));
}

}  // namespace
}  // namespace vitrel
