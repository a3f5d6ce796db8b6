// The program from outside, in space, with soft particles and with overlaps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/io/checked.h"
#include "core/io/h5md.h"
#include "tests/app/program.h"
#include "tests/app/systems.h"

namespace vitrel {
namespace {

using testing::HasSubstr;
using testing_program::expect_refusal;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using testing_program::small_packing;
using testing_program::small_system;
using testing_program::soft_system;
using Json = nlohmann::json;

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

}  // namespace
}  // namespace vitrel
