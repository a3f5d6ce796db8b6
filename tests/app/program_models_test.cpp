// The program from outside, in space, with soft particles and with overlaps.

#include "core/io/checked.h"
#include "core/io/h5md.h"
#include "tests/app/end_to_end.h"
#include "tests/app/systems.h"

namespace vitrel {
namespace {

using Json = nlohmann::json;

/// Writes the state of state.h5 into overlap.h5 with particle 7 so far from particle 3.
template <int Dim>
void write_overlap(const Folder& folder, const Vec<Dim>& distance) {
  Configuration<Dim> state = read_state<Dim>(folder / "state.h5");
  state.position[7] = state.position[3] + distance;
  state.box.wrap(state.position[7], state.image[7]);
  write_state(folder / "overlap.h5", state, Provenance{});
}

TEST(Program, PreparesAndChecksAPackingOfThreeDimensions) {
  const Folder folder("packing", small_packing);
  const Json summary = folder.summary("prepare p.toml -o state.h5");
  EXPECT_NEAR(summary["packing_fraction"].get<double>(), 0.2, 1e-12);
  EXPECT_EQ(summary["overlaps"], 0);
  EXPECT_GT(summary["reduced_pressure"], 1);
  EXPECT_GT(summary["collisions"], 20);
  EXPECT_GE(summary["orientation_ratio"], 1);
  EXPECT_EQ(summary["stages"].size(), 2u);
  EXPECT_EQ(Json::parse(folder.read("state.quality.json"))["dimension"], 3);
  EXPECT_EQ(folder.summary("check state.h5")["box"].size(), 3u);

  write_overlap<3>(folder, {0.1, 0.05, 0});
  const Outcome overlapping = folder.run("check overlap.h5 -q");
  EXPECT_EQ(overlapping.code, 4);
  EXPECT_THAT(overlapping.errors, HasSubstr("particles 3 and 7, image (0, 0, 0)"));
}

// Spheroids at φ = 0.2: Z of the run and that of the preparation's report are both near that of spheres, 2.4.
TEST(Program, RunsInThreeDimensions) {
  const Folder folder("run_in_three", small_packing + "[dynamics]\nduration = 100\n");
  const Json summary = folder.summary("run p.toml -o run.h5");
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
  folder.succeed("check run.h5 -q");
  folder.succeed("analyze run.h5 -q");
  EXPECT_THAT(folder.read("run_results/energies.csv"), HasSubstr("translational"));
  EXPECT_TRUE(fs::exists(folder / "run_results/compressibility_factor.csv"));
  EXPECT_TRUE(fs::exists(folder / "run_results/structure_factor.csv"));
  folder.succeed("report run.h5 -q");
}

// Damped disks, close to one another after contact: the file says which, and the check knows.
TEST(Program, RunsSoftParticles) {
  const Folder folder("soft", soft_system);
  checked(setenv("XDG_CACHE_HOME", folder.path().c_str(), 1), "setenv");
  const Json summary = folder.summary("run p.toml -o run.h5");
  EXPECT_EQ(summary["overlaps"], 0);
  EXPECT_GT(summary["collisions"], 100);
  EXPECT_GT(summary["early_releases"], 0);
  EXPECT_EQ(summary["early_releases_per_collision"],
            summary["early_releases"].get<double>() / summary["collisions"].get<double>());
  EXPECT_GT(summary["dissipated_energy"], 1);
  EXPECT_LT(summary["energy_drift"], 1e-11);
  EXPECT_GT(folder.summary("check run.h5")["close_pairs"], 0);
  Configuration2 close;
  const TrajectoryReader reader(folder / "run.h5");
  for (std::uint64_t k = 0; k < reader.frames() && close.close_pairs.empty(); ++k)
    close = reader.read(k);
  ASSERT_FALSE(close.close_pairs.empty());
  write_state(folder / "close.h5", close, Provenance{});
  const std::string from_close = "run p.toml --from close.h5 -q --set dynamics.duration=1 -o ";
  folder.succeed(from_close + "on.h5");
  // In closed form, with m_eff = 2.3876 kg: β = γ/(2 m_eff), ω = √(k/m_eff − β²),
  // ω τ = π − atan(2βω/(ω² − β²)), exp(−β τ).
  EXPECT_THAT(
      folder.run("run p.toml -o new.h5 --dry-run").output,
      AllOf(HasSubstr("linear_dashpot; head-on at 2 m/s it lasts 0.0144 s and leaves 0.7393"),
            HasSubstr("time 0.05 s")));
  // For hard particles it is no state.
  folder.write("p.toml", soft_system.substr(0, soft_system.find("[dynamics.contact]")));
  folder.expect_refusal(from_close + "hard.h5", 4, "overlapping pair(s)");
}

TEST(Program, SaysWhatThreeDimensionsDoNotHave) {
  const Folder folder("three_dimensions", small_packing);
  folder.succeed("prepare p.toml -o state.h5 -q");
  folder.write("flat.toml", small_system);
  folder.expect_refusal("run flat.toml -o a.h5 --from state.h5 -q --set system.dimension=2", 2,
                        "key 'system.dimension' is 2, but that of the state is 3 (state.h5)");
}

// Two particles on top of each other: both ways to look must see it.
TEST(Program, AnOverlapExitsWithFourUnlessItIsToBeCorrected) {
  const Folder folder("overlap", small_system);
  folder.succeed("prepare p.toml -o state.h5 -q");
  write_overlap<2>(folder, {0.1, 0.05});

  const Outcome checked = folder.run("check overlap.h5 -q");
  EXPECT_EQ(checked.code, 4);
  EXPECT_THAT(checked.errors, HasSubstr("particles 3 and 7"));
  folder.expect_refusal("run p.toml -o a.h5 --from overlap.h5 -q", 4, "overlapping pair(s)");
  EXPECT_GT(folder.summary("run p.toml -o b.h5 --from overlap.h5 --set dynamics.on_overlap=correct")
                ["correction_moves"],
            0);
}

}  // namespace
}  // namespace vitrel
