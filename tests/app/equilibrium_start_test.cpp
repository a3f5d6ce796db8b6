// States sampled until they have decorrelated, runs from them, and sweeps of which only the results are left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace vitrel {
namespace {

using testing::HasSubstr;
using testing_program::expect_refusal;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using testing_program::succeed;
using testing_program::summary_of;
using Json = nlohmann::json;

std::string liquid(const std::string& sampling) {
  return "[system]\nparticles = 100\npacking_fraction = 0.5\n"
         "[[species]]\naspect_ratio = 2\nsize = { distribution = \"uniform\", low = 0.7, high = "
         "1.3 }\n"
         "[prepare]\nquality_sweeps = 0\n"
         "[[prepare.stage]]\nmethod = \"insert\"\npacking_fraction = 0.3\n"
         "[[prepare.stage]]\nmethod = \"swell\"\n"
         "[[prepare.stage]]\nmethod = \"sample\"\ncollective_exchanges = 2\n" +
         sampling +
         "\n[dynamics]\nkind = \"brownian\"\nequilibration = 0\nduration = 25\n"
         "[output]\nsamples = { spacing = \"linear\", interval = 0.25 }\n"
         "[analysis]\nstructure = { frames = 0 }\n";
}

/// τ_2 is about 4: less than a third of the run, and more than a sixteenth.
Json analysis_from(const Folder& folder, const std::string& decorrelations) {
  folder.write("p.toml", liquid("decorrelations = " + decorrelations));
  const std::string output = "run" + decorrelations + ".h5";
  succeed(folder, {"run", "p.toml", "-o", output, "-q"});
  return summary_of(folder, {"analyze", output});
}

TEST(EquilibriumStart, IsVouchedForByTenDecorrelations) {
  const Folder folder("vouched_for");
  const Json few = analysis_from(folder, "9"), enough = analysis_from(folder, "10");
  EXPECT_EQ(few["verdict"], "not enough time");
  EXPECT_THAT(few["reason"].get<std::string>(), HasSubstr("16 times are needed"));
  EXPECT_EQ(enough["verdict"], "equilibrated") << enough["reason"];
}

TEST(EquilibriumStart, ThePreparationCountsDecorrelations) {
  const Folder folder("decorrelations");
  folder.write("p.toml", liquid("decorrelations = 3"));
  const Json summary = summary_of(folder, {"prepare", "p.toml", "-o", "s.h5"});
  const Json& stage = summary["stages"].back();
  EXPECT_EQ(stage["decorrelations"], 3);
  EXPECT_GT(stage["sweeps"], 10);
  EXPECT_NEAR(stage["reduced_pressure"].get<double>(), 4.4, 0.6);
  EXPECT_THAT(stage["end"].get<std::string>(), HasSubstr("decorrelated 3 times in "));

  folder.write("p.toml", liquid("decorrelations = 3\nmax_sweeps = 5"));
  expect_refusal(run(folder.path(), {"prepare", "p.toml", "-o", "t.h5"}), 2,
                 "only 0 of 3 decorrelations within max_sweeps = 5; raise it, or exchange places");
  folder.write("p.toml", liquid("decorrelations = 3\nsweeps = 5"));
  expect_refusal(run(folder.path(), {"prepare", "p.toml", "-o", "u.h5"}), 2,
                 "sweeps' has no effect beside decorrelations; give max_sweeps instead");
  folder.write("p.toml", liquid("max_sweeps = 5"));
  expect_refusal(run(folder.path(), {"prepare", "p.toml", "-o", "u.h5"}), 2,
                 "max_sweeps' has no effect without decorrelations; give sweeps instead");
}

// What is kept of a study whose runs are too large to keep.
TEST(EquilibriumStart, SweepsAreAnalysedFromTheirResultsAlone) {
  const Folder folder("results_alone");
  folder.write("p.toml", liquid("decorrelations = 10") +
                             "[sweep.grid]\n\"system.packing_fraction\" = [0.5, 0.52]\n");
  succeed(folder, {"sweep", "p.toml", "-o", "all", "-q"});
  const std::vector<std::string> analysis = {"analyze", "all", "-q", "--json", "-o", "a.h5"};
  const Outcome before = run(folder.path(), analysis);
  const auto jobs = std::filesystem::directory_iterator(folder / "all");
  for (const auto& job : jobs)
    if (job.is_directory())
      for (const char* file : {"run.h5", "state.h5"}) std::filesystem::remove(job.path() / file);
  EXPECT_EQ(run(folder.path(), analysis).output, before.output);
  const Json status = summary_of(folder, {"sweep", "p.toml", "-o", "all", "--status"});
  for (const Json& job : status["jobs"]) EXPECT_EQ(job["stage"], "done");
  succeed(folder, {"sweep", "p.toml", "-o", "all", "-q"});
  EXPECT_FALSE(std::filesystem::exists(folder / "all/packing_fraction-0.5/run.h5"));
}

}  // namespace
}  // namespace vitrel
