// States sampled until they have decorrelated, runs from them, and sweeps of which only the results are left.

#include "tests/app/end_to_end.h"

namespace vitrel {
namespace {

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
  folder.succeed("run p.toml -q -o run" + decorrelations + ".h5");
  return folder.summary("analyze run" + decorrelations + ".h5");
}

TEST(EquilibriumStart, IsVouchedForByTenDecorrelations) {
  const Folder folder("vouched_for");
  const Json few = analysis_from(folder, "9"), enough = analysis_from(folder, "10");
  EXPECT_EQ(few["verdict"], "not enough time");
  EXPECT_THAT(few["reason"].get<std::string>(), HasSubstr("16 times are needed"));
  EXPECT_EQ(enough["verdict"], "equilibrated") << enough["reason"];
}

TEST(EquilibriumStart, ThePreparationCountsDecorrelations) {
  const Folder folder("decorrelations", liquid("decorrelations = 3"));
  const Json summary = folder.summary("prepare p.toml -o s.h5");
  const Json& stage = summary["stages"].back();
  EXPECT_EQ(stage["decorrelations"], 3);
  EXPECT_GT(stage["sweeps"], 10);
  EXPECT_NEAR(stage["reduced_pressure"].get<double>(), 4.4, 0.6);
  EXPECT_THAT(stage["end"].get<std::string>(), HasSubstr("decorrelated 3 times in "));

  for (const auto& [sampling, complaint] :
       {std::pair("decorrelations = 3\nsweeps = 5",
                  "sweeps' has no effect beside decorrelations; give max_sweeps instead"),
        {"max_sweeps = 5", "max_sweeps' has no effect without decorrelations; give sweeps instead"},
        // This one is refused only after its sweeps.
        {"decorrelations = 3\nmax_sweeps = 5",
         "only 0 of 3 decorrelations within max_sweeps = 5; raise it, or exchange places"}}) {
    folder.write("p.toml", liquid(sampling));
    folder.expect_refusal("prepare p.toml -o t.h5", 2, complaint);
  }
}

// What is kept of a study whose runs are too large to keep.
TEST(EquilibriumStart, SweepsAreAnalysedFromTheirResultsAlone) {
  const Folder folder(
      "results_alone",
      liquid("decorrelations = 10") + "[sweep.grid]\n\"system.packing_fraction\" = [0.5, 0.52]\n");
  folder.succeed("sweep p.toml -o all -q");
  const std::string before = folder.run("analyze all -q --json -o a.h5").output;
  for (const auto& job : fs::directory_iterator(folder / "all"))
    if (job.is_directory())
      for (const char* file : {"run.h5", "state.h5"}) fs::remove(job.path() / file);
  EXPECT_EQ(folder.run("analyze all -q --json -o a.h5").output, before);
  const Json status = folder.summary("sweep p.toml -o all --status");
  for (const Json& job : status["jobs"]) EXPECT_EQ(job["stage"], "done");
  folder.succeed("sweep p.toml -o all -q");
  EXPECT_FALSE(fs::exists(folder / "all/packing_fraction-0.5/run.h5"));
}

}  // namespace
}  // namespace vitrel
