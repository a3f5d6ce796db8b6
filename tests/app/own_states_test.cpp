// States from elsewhere: files of other programs, and particles in the parameter file.

#include <cmath>
#include <fstream>

#include "core/io/h5md.h"
#include "tests/app/end_to_end.h"
#include "tests/support/refused_texts.h"

namespace vitrel {
namespace {

using Json = nlohmann::json;

constexpr const char* three_ellipses =
    "x,y,angle,a,b,box_x,box_y\n"
    "0,0,0,1,0.5,6,6\n"
    "2.5,0.1,0.3,1,0.5,6,6\n"
    "0,2,1.2,1,0.5,6,6\n";
const std::string run_in_plane =
    "[dynamics]\nequilibration = 0\nduration = 4\n[output]\nsamples.interval = 1\n";

TEST(OwnStates, AShortTableStartsPreparationAndRun) {
  const Folder folder("from_csv", run_in_plane);
  folder.write("mine.csv", three_ellipses);
  const Json ran = folder.summary("run p.toml --from mine.csv -o run.h5");
  EXPECT_EQ(ran["particles"], 3);
  EXPECT_NEAR(ran["packing_fraction"], 3 * M_PI * 0.5 / 36, 1e-15);
  const Configuration2 first = TrajectoryReader(folder / "run.h5").read<2>(0);
  EXPECT_EQ(first.position[1], Vec2(2.5, 0.1));
  EXPECT_EQ(first.angle[2], 1.2);
  EXPECT_EQ(first.mass[0], 0.5);
  EXPECT_THAT(TrajectoryReader(folder / "run.h5").provenance().parameters,
              AllOf(HasSubstr("particles = 3"), HasSubstr("semi_axes = [1.0, 0.5]"),
                    HasSubstr("method = \"state\"")));
  folder.succeed("run '" VITREL_PARAMS
                 "/own_state.toml' --from mine.csv -o own.h5 -q --set dynamics.duration=1");
  // The stages that move particles follow, if the file does not place them itself.
  folder.write("denser.toml",
               "[system]\npacking_fraction = 0.4\n[[prepare.stage]]\nmethod = \"swell\"\n");
  const Json denser = folder.summary("prepare denser.toml --from mine.csv -o denser.h5");
  EXPECT_NEAR(denser["packing_fraction"], 0.4, 1e-12);
  folder.write("other.toml", "[[prepare.stage]]\nmethod = \"insert\"\n");
  const Json same = folder.summary("prepare other.toml --from mine.csv -o same.h5");
  EXPECT_EQ(same["packing_fraction"], ran["packing_fraction"]);
  // The same as a stage of the parameter file, relative to that.
  fs::create_directory(folder / "below");
  folder.write("below/stage.toml",
               "[system]\npacking_fraction = 0.4\n[[prepare.stage]]\nmethod = \"state\"\n"
               "file = \"../mine.csv\"\n[[prepare.stage]]\nmethod = \"swell\"\n");
  folder.succeed("prepare below/stage.toml -o stage.h5 -q");
  folder.expect_same_datasets("stage.h5", "denser.h5");
}

/// A run of two species in two or three dimensions, with velocities.
std::string two_species(int dimension) {
  const std::string shape = dimension == 2 ? "aspect_ratio = 2" : "semi_axes = [1.2, 1.0, 0.7]";
  return fmt::format(
             "[system]\nparticles = 20\npacking_fraction = 0.2\ndimension = {}\n[[species]]\n"
             "name = \"A\"\n{}\nfraction = 0.5\n[[species]]\nname = \"B\"\naspect_ratio = 1.5\n"
             "size = 0.6\nfraction = 0.5\n[[prepare.stage]]\nmethod = \"insert\"\n"
             "packing_fraction = 0.2\n",
             dimension, shape) +
         run_in_plane;
}

class RoundTrip : public testing::TestWithParam<int> {
 protected:
  RoundTrip() {
    folder.write("none.toml", "# all defaults\n");
    folder.succeed("run p.toml -o run.h5 -q");
  }

  const Folder folder{"round_trip", two_species(GetParam())};
};

TEST_P(RoundTrip, TextsAreLossless) {
  for (const std::string format : {"xyz", "csv"}) {
    const std::string once = "once." + format, twice = "twice." + format;
    folder.succeed("export run.h5 -q --to " + format + " -o " + once);
    folder.succeed("export " + once + " -q --to " + format + " -o " + twice);
    EXPECT_EQ(folder.read(once), folder.read(twice)) << format;
    // All commands see the same run.
    const Json check = folder.summary("check " + once);
    EXPECT_EQ(check["frames"], 5);
    EXPECT_EQ(check["smallest_gap"], folder.summary("check run.h5")["smallest_gap"]);
    Json of_copy = folder.summary("analyze " + once + " -o copy.h5");
    Json of_run = folder.summary("analyze run.h5 -o results.h5");
    for (const char* key : {"packing_fraction", "frames", "duration", "translational_energy"})
      EXPECT_EQ(of_copy[key], of_run[key]) << key;
  }
}

TEST_P(RoundTrip, AStateOfH5mdKeepsAllBits) {
  folder.succeed("prepare none.toml --from run.h5 -o once.h5 -q");
  folder.succeed("prepare none.toml --from once.h5 -o twice.h5 -q");
  folder.expect_same_datasets("once.h5", "twice.h5");
  for (const std::string format : {"xyz", "csv"}) {
    folder.succeed("export run.h5 -q --to " + format + " -o run." + format);
    folder.succeed("prepare none.toml -q --from run." + format + " -o " + format + ".h5");
    folder.expect_same_datasets("once.h5", format + ".h5");
  }
}

TEST_P(RoundTrip, GsdIsGoodToSinglePrecision) {
  folder.succeed("export run.h5 --to gsd -q");
  folder.succeed("prepare none.toml --from run.gsd -o gsd.h5 -q");
  folder.succeed("prepare none.toml --from run.h5 -o h5.h5 -q");
  const auto expected = all_datasets(folder / "h5.h5");
  const auto found = all_datasets(folder / "gsd.h5");
  for (const auto& [name, values] : expected) {
    ASSERT_TRUE(found.contains(name)) << name;
    const std::vector<double>& others = found.at(name);
    ASSERT_EQ(values.size(), others.size()) << name;
    // Angles come from quaternions, and so without their turns.
    if (name.find("angle/") != std::string::npos) continue;
    for (std::size_t k = 0; k < values.size(); ++k)
      EXPECT_NEAR(values[k], others[k], 1e-6 * std::max(1., std::abs(values[k]))) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, RoundTrip, testing::Values(2, 3));

TEST(OwnStates, WhatIsGivenMustAgreeInItsDigits) {
  const Folder folder("digits", run_in_plane + "[system]\nparticles = 3\n");
  folder.write("mine.csv", three_ellipses);
  // φ = 0.130899693…
  const auto start = [&](const std::string& setting) {
    return folder.run("run p.toml --from mine.csv -o a.h5 --dry-run --set " + setting);
  };
  for (const char* fits : {"system.packing_fraction=0.1309", "system.packing_fraction=0.130900",
                           "system.packing_fraction=0.13089969", "species.0.aspect_ratio=2"})
    EXPECT_EQ(start(fits).code, 0) << fits << start(fits).errors;
  EXPECT_THAT(start("system.packing_fraction=0.1309").output,
              HasSubstr("packing fraction 0.1308996938995747"));
  for (const auto& [setting, complaint] :
       {std::pair("system.packing_fraction=0.13088", "is 0.13088, but that of the state is 0.1308"),
        {"system.packing_fraction=0.13", "is 0.13, but that of the state is 0.1308"},
        {"system.particles=4", "'system.particles' is 4, but that of the state is 3 (mine.csv)"},
        {"system.dimension=3", "mine.csv: frame 0: is two-dimensional"},
        {"system.box_aspect=1.1", "'system.box_aspect' is 1.1, but that of the state 1"},
        {"species.0.aspect_ratio=2.1", "'species.0.aspect_ratio' is 2.1, but particle 0 has 2"}})
    EXPECT_THAT(start(setting).errors, HasSubstr(complaint)) << setting;
}

TEST(OwnStates, AFileIsRefusedInItsOwnTerms) {
  const Folder folder("bad_files", run_in_plane);
  const auto expect_refusal = [&](const std::string& name, const std::string& text,
                                  const std::string& complaint) {
    folder.write(name, text);
    folder.expect_refusal("check -q " + name, 3, complaint);
    folder.expect_refusal("run p.toml -o a.h5 -q --from " + name, 3, complaint);
    EXPECT_FALSE(fs::exists(folder / "a.h5"));
  };
  const fs::path tests = fs::path(VITREL_FIXTURES).parent_path();
  for (const std::string format : {"csv", "xyz"})
    for (const auto& [text, complaint] :
         refused_texts(tests / "app/bad_states" / (format + ".txt")))
      expect_refusal("a." + format, text, complaint);
  expect_refusal("bad.h5", std::string("\0\1\2", 3), "it is binary, and none of these begins so");
  folder.expect_refusal("check none.csv -q", 3, "none.csv: cannot open");
  // A GSD file with its end cut off.
  folder.write("two.toml", two_species(2));
  folder.succeed("run two.toml -o run.h5 -q");
  folder.succeed("export run.h5 --to gsd -q");
  const std::string whole = folder.read("run.gsd");
  expect_refusal("cut.gsd", whole.substr(0, whole.size() / 2), "cut.gsd: is truncated or damaged");
}

TEST(OwnStates, OverlapsAreNamedOrShrunk) {
  const Folder folder("overlapping", run_in_plane);
  folder.write("mine.csv",
               "x,y,radius,box_x,box_y\n-2,0,1,8,8\n0,0,1,8,8\n1.99,0,1,8,8\n0,3,1,8,8\n");
  const std::string start = "run p.toml --from mine.csv -o a.h5";
  folder.expect_refusal(
      start, 4,
      "mine.csv: has 1 overlapping pair(s), the deepest of particles 1 and 2, image (0, "
      "0), which would touch if scaled by 0.995;");
  EXPECT_THAT(folder.run("check mine.csv").errors,
              HasSubstr("particles 1 and 2, image (0, 0), would touch if scaled by 1 − 0.005"));
  const Outcome shrunk = folder.run(start + " --shrink");
  EXPECT_EQ(shrunk.code, 0) << shrunk.errors;
  EXPECT_THAT(shrunk.errors, HasSubstr("mine.csv: all particles are scaled by 1 − 0.005"));
  const Configuration2 first = TrajectoryReader(folder / "a.h5").read<2>(0);
  EXPECT_NEAR(first.shape[3].a, 0.995, 1e-15);
  folder.succeed("check a.h5 -q");
  // The same command finds it complete, and goes on.
  EXPECT_THAT(folder.run(start + " --shrink").errors, HasSubstr("complete already"));
}

TEST(OwnStates, ShapesMayComeFromTheParameters) {
  const Folder folder("shapes_elsewhere",
                      "[system]\ndimension = 3\n"
                      "[[species]]\nname = \"ball\"\naspect_ratio = 1\nsize = 1.5\n"
                      "fraction = 0.333333333333333\n"
                      "[[species]]\nname = \"rod\"\nsemi_axes = [2, 0.5, 0.5]\n"
                      "fraction = 0.666666666666667\nmass = 7\n" +
                          run_in_plane);
  const std::string keys =
      "3\nLattice=\"9 0 0 0 9 0 0 0 9\" Properties=species:S:1:pos:R:3:orientation:R:4 ";
  folder.write("mine.xyz",
               keys + "Time=0\nrod 1 1 1 0 0 0 1\nball 5 5 5 0 0 0 1\nrod 1 5 1 0 0 0 1\n" + keys +
                   "Time=2\nrod 1 1 2 0 0 0 1\nball 5 5 5 0 0 0 1\nrod 1 5 1 0 0 0 1\n");
  folder.expect_refusal(
      "check mine.xyz -q", 3,
      "mine.xyz: frame 0: has no sizes: it has no property aspherical_shape or radius, and "
      "neither [[import.species]] nor [[species]] gives diameter or semi-axes of ball, rod");
  const Json check = folder.summary("check mine.xyz --params p.toml");
  const double volume = 4 * M_PI / 3 * (1.5 * 1.5 * 1.5 + 2 * 2 * 0.25);
  EXPECT_NEAR(check["packing_fraction"], volume / 729, 1e-15);
  const Outcome analysed = folder.run("analyze mine.xyz --params p.toml -o r.h5");
  EXPECT_EQ(analysed.code, 0);
  EXPECT_THAT(analysed.errors,
              HasSubstr("mine.xyz: motion is left out: box crossings are unknown: it has no "
                        "property map_shift; if no particle moves by more than half a box length "
                        "between frames, import.unwrap = \"nearest\" counts them"));
  folder.succeed("run p.toml --from mine.xyz -o run.h5 -q");
  const Configuration3 first = TrajectoryReader(folder / "run.h5").read<3>(0);
  EXPECT_THAT(first.species_names, ElementsAre("ball", "rod"));
  EXPECT_THAT(first.species, ElementsAre(1, 0, 1));
  EXPECT_EQ(first.mass[0], 7);
  // In the last frame, with the box centred at the origin.
  EXPECT_EQ(first.position[0], Vec3(-3.5, -3.5, -2.5));
}

TEST(OwnStates, HarmlessDifferencesOfATextAreRead) {
  const Folder folder("harmless");
  folder.write("right.csv", "x,y,angle,a,b,box_x,box_y\n-2,-2,1.5707963267948966,1,0.5,6,6\n");
  const Json right = folder.summary("check right.csv");
  const std::string properties =
      "Properties = species:S:1:pos:R:3:orientation:R:4:aspherical_shape:R:3\n"
      "A 1.0D0 1 1e-7 0 0 0 1 0.5D0 1.0d+00 1\n";
  for (const char* lattice : {"\"6 0 0 0 6 0 0 0 6\"", "\"6.,0.,0., 0.,6.,0., 0.,0.,6.\"",
                              "[[6, 0, 0], [0, 6, 0], [0, 0, 6]]"}) {
    SCOPED_TRACE(lattice);
    folder.write("a.xyz", fmt::format("1\nLattice = {} pbc = \"T T F\" {}", lattice, properties));
    const Outcome found = folder.run("check a.xyz --json");
    ASSERT_EQ(found.code, 0) << found.errors;
    EXPECT_EQ(Json::parse(found.output)["smallest_gap"], right["smallest_gap"]);
    EXPECT_THAT(found.errors,
                HasSubstr("semi-axes a < b are exchanged, and their particles turned by π/2"));
  }
}

/// `frames` of one disk in straight flight through a box of 10, inside it, without images.
std::string flight(double step, int frames) {
  std::string text = "time,x,y,radius,vx,vy,box_x,box_y\n";
  for (int k = 0; k < frames; ++k) {
    const double x = k * step - 10 * std::round(k * step / 10);
    for (const double y : {0., 3.}) text += fmt::format("{},{},{},1,{},0,10,10\n", k, x, y, step);
  }
  return text;
}

TEST(OwnStates, UnknownBoxCrossingsAreCountedByNearestImagesOnRequest) {
  const Folder folder("nearest");
  const std::string analyze = "analyze flight.csv -o r.h5 --set import.unwrap=\"nearest\"";
  folder.write("flight.csv", flight(4, 8));
  const Outcome counted = folder.run(analyze);
  ASSERT_EQ(counted.code, 0) << counted.errors;
  EXPECT_THAT(counted.errors,
              AllOf(HasSubstr("the longest step is 0.4 box lengths along x, of particle 0"),
                    HasSubstr("above 0.25, longer steps that were taken for shorter ones cannot be "
                              "excluded")));
  const Datasets found = all_datasets(folder / "r.h5");
  const std::vector<double>& msd = found.at("/displacements_all/msd");
  for (std::size_t k = 0; k < msd.size(); ++k) EXPECT_NEAR(msd[k], 16. * (k + 1) * (k + 1), 1e-9);
  // Steps of 6 look like steps of −4; the velocities tell.
  folder.write("flight.csv", flight(6, 8));
  folder.expect_refusal(
      analyze, 3,
      "frame 1: particle 0 has the same velocity as in the frame before and flew by (6, "
      "0), but its nearest image moved by (-4, 0)");
}

// Up to the precision of the format: GSD has floats, and no angles that count turns.
TEST(OwnStates, RunsInOtherFormatsAreAnalysedLikeTheirOwn) {
  const Folder folder("analyse_other_formats",
                      "[system]\nparticles = 20\n" + run_in_plane + "velocities = true\n");
  folder.succeed("run p.toml -o run.h5 -q --set output.samples.interval=0.1");
  folder.succeed("analyze run.h5 -o right.h5 -q");
  const Datasets right = all_datasets(folder / "right.h5");
  for (const auto& [format, tolerance] : {std::pair("csv", 0.), {"xyz", 0.}, {"gsd", 1e-5}}) {
    const std::string file = std::string("run.") + format, results = file + ".results.h5";
    folder.succeed(fmt::format("export run.h5 --to {} -o {} -q", format, file));
    folder.succeed("analyze " + file + " -q -o " + results);
    const Datasets found = all_datasets(folder / results);
    for (const char* name :
         {"/displacements_all/msd", "/displacements_all/msr", "/energies/rotational"}) {
      SCOPED_TRACE(file + ": " + name);
      const std::vector<double>&one = right.at(name), &other = found.at(name);
      ASSERT_EQ(one.size(), other.size());
      for (std::size_t k = 0; k < one.size(); ++k)
        EXPECT_NEAR(one[k], other[k], tolerance * one[k]);
    }
  }
}

// OVITO and others colour by type.
TEST(OwnStates, DisksOfManySizesStayOneSpeciesInGsd) {
  const Folder folder(
      "sizes_in_gsd",
      "[system]\nparticles = 12\npacking_fraction = 0.3\n"
      "[[species]]\nname = \"L\"\nfraction = 0.5\naspect_ratio = 1\nsize = { distribution = "
      "\"gaussian\", mean = 1.0, standard_deviation = 0.1 }\n"
      "[[species]]\nname = \"E\"\nfraction = 0.5\naspect_ratio = 2\n" +
          run_in_plane);
  folder.succeed("run p.toml -o run.h5 -q");
  folder.succeed("export run.h5 --to gsd -q");
  const Configuration2 right = TrajectoryReader(folder / "run.h5").read(0),
                       found = TrajectoryReader(folder / "run.gsd").read(0);
  EXPECT_THAT(found.species_names, testing::UnorderedElementsAre("L", "E"));
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_EQ(found.species_names[static_cast<std::size_t>(found.species[i])],
              right.species_names[static_cast<std::size_t>(right.species[i])]);
    EXPECT_NEAR(found.shape[i].a, right.shape[i].a, 1e-6);
    EXPECT_NEAR(found.shape[i].b, right.shape[i].b, 1e-6);
  }
}

TEST(OwnStates, DifferentParticlesNeedNoSpecies) {
  const Folder folder("polydisperse", run_in_plane);
  folder.write("mine.csv", "x,y,radius,box_x,box_y\n-2,0,1,8,8\n0.5,0,0.8,8,8\n0,3,0.9,8,8\n");
  folder.succeed("run p.toml --from mine.csv -o a.h5 -q");
  EXPECT_THAT(TrajectoryReader(folder / "a.h5").provenance().parameters,
              HasSubstr("distribution = \"uniform\", low = 0.8, high = 1.0"));
  folder.succeed("run p.toml --from a.h5 -o b.h5 -q");
}

TEST(OwnStates, TheTwoEllipsesOfTheThesisMeetWhenTheyShould) {
  const Folder folder("two_ellipses");
  const std::string run_scene = "run '" VITREL_PARAMS "/two_ellipses.toml' -o ";
  const auto collisions = [&](const std::string& duration) {
    return folder.summary(run_scene + duration + ".h5 --set output.samples.interval=0.01 " +
                          "--set dynamics.duration=" + duration)["collisions"];
  };
  EXPECT_EQ(collisions("0.0847223858218"), 0);
  EXPECT_EQ(collisions("0.084722385822"), 1);
  const Json whole = folder.summary(run_scene + "two.h5");
  EXPECT_EQ(whole["collisions"], 1);
  EXPECT_LT(whole["energy_drift"], 1e-14);
}

TEST(OwnStates, TheSoftPairLeavesAsInTheArticle) {
  const Folder folder("soft_pair");
  folder.succeed("run '" VITREL_PARAMS "/soft_pair.toml' -o pair.h5 -q");
  const TrajectoryReader reader(folder / "pair.h5");
  const Configuration3 last = reader.read<3>(reader.frames() - 1);
  // An independent integration (docs/soft-particles.md).
  EXPECT_LT((last.velocity[0] - Vec3(-0.11139609, 0.34553273, 0)).norm(), 1e-8);
  EXPECT_LT((last.velocity[1] - Vec3(0.61139609, -0.34553273, 0)).norm(), 1e-8);
}

TEST(OwnStates, ParticlesInTheParameterFileAreCheckedWithTheirPlaces) {
  const Folder folder("inline");
  const std::string stage =
      "[[prepare.stage]]\nmethod = \"state\"\nbox = [9, 9]\npositions = [[0, 0], [3, 0]]\n";
  for (const auto& [more, complaint] :
       {std::pair("angles = [0]\n",
                  "p.toml:10:10: key 'prepare.stage.0.angles' has 1 entries, but positions has 2"),
        {"velocities = [[1, 0], [1]]\n",
         "velocities' has 1 numbers for particle 1, but must have 2"},
        {"quaternions = [[1, 0, 0, 0], [1, 0, 0, 0]]\n", "is for three dimensions; give angles"},
        {"file = \"a.csv\"\n", "'prepare.stage.0.file' excludes positions"},
        {"semi_axes = [[1, 0.5], [1, 2]]\n", "particle 1 has the semi-axes 1, 2"}}) {
    folder.write("p.toml", run_in_plane + stage + more);
    folder.expect_refusal("run p.toml -o a.h5 -q", 2, complaint);
  }
  folder.write("p.toml", "[[prepare.stage]]\nmethod = \"state\"\n");
  folder.expect_refusal("prepare p.toml -o a.h5 -q", 2,
                        "'prepare.stage.0.file' is missing; give a file, or positions");
}

TEST(OwnStates, APreparationFromAStateContinuesAfterAStop) {
  const Folder folder("continued",
                      "[[prepare.stage]]\nmethod = \"sample\"\nsweeps = 3000\n[prepare]\n"
                      "quality_sweeps = 10\n");
  folder.write("mine.csv", three_ellipses);
  const std::string prepare = "prepare p.toml --from mine.csv -q -o ";
  folder.succeed(prepare + "whole.h5");
  int stops = 0;
  while (folder.run(prepare + "parts.h5 --wall-time 1e-6").code == 5 && stops < 3) ++stops;
  EXPECT_GT(stops, 0);
  fs::remove(folder / "mine.csv");
  if (!fs::exists(folder / "parts.h5")) folder.succeed(prepare + "parts.h5");
  folder.expect_same_datasets("whole.h5", "parts.h5");
}

// The parameters of a job hold all keys, the packing fraction with its default, too.
TEST(OwnStates, ASweepRunsStatesThatWerePreparedUpToAPressure) {
  const Folder folder("sweep_at_pressure");
  const std::string ends[] = {"method = \"compress\"\npressure = 0.5\nsweeps = 50\n",
                              "method = \"grow\"\nreduced_pressure = 5\ngrowth_rate = 0.1\n"};
  for (const std::string& end : ends) {
    folder.write("p.toml",
                 "[system]\nparticles = 20\n[[prepare.stage]]\npacking_fraction = 0.2\n"
                 "[[prepare.stage]]\n" +
                     end + "[[prepare.stage]]\nmethod = \"sample\"\nsweeps = 5\n" + run_in_plane +
                     "[sweep.grid]\n\"system.seed\" = [1]\n");
    const Json job = folder.summary("sweep p.toml -o " + end.substr(10, 4))["jobs"][0];
    EXPECT_EQ(job["run"]["packing_fraction"], job["prepare"]["packing_fraction"]) << end;
  }
}

TEST(OwnStates, ADensityLadderStartsFromTheDensityBefore) {
  const Folder folder(
      "ladder",
      "[system]\nparticles = 20\n[[prepare.stage]]\nmethod = \"insert\"\n"
      "[[prepare.stage]]\nmethod = \"swell\"\n" +
          run_in_plane +
          "[sweep]\nladder = \"system.packing_fraction\"\n[sweep.grid]\n"
          "\"system.packing_fraction\" = [0.3, 0.4, 0.5]\n\"system.seed\" = [1, 2]\n");
  const Json sweep = folder.summary("sweep p.toml -o sweep -j 2");
  ASSERT_EQ(sweep["jobs"].size(), 6u);
  const auto job = [](const std::string& phi) {
    return "sweep/packing_fraction-" + phi + "_seed-2";
  };
  for (const auto& [before, phi] : {std::pair("0.3", "0.4"), {"0.4", "0.5"}}) {
    const TrajectoryReader state(folder / (job(phi) + "/state.h5"));
    EXPECT_THAT(state.provenance().parameters,
                HasSubstr("packing_fraction-" + std::string(before) + "_seed-2/run.h5"));
    EXPECT_NEAR(packing_fraction(state.read<2>(0)), std::stod(phi), 1e-12);
  }
  // By hand: the second state from the end of the first run.
  folder.write(
      "second.toml",
      "[system]\npacking_fraction = 0.4\nseed = 2\n[[prepare.stage]]\nmethod = \"swell\"\n");
  folder.succeed("prepare second.toml -o second.h5 -q --from " + job("0.3") + "/run.h5");
  folder.expect_same_datasets("second.h5", job("0.4") + "/state.h5");
  // A single job waits for no other.
  folder.expect_refusal(
      "sweep p.toml -o single --job packing_fraction-0.4_seed-1 -q", 2,
      "starts from the end of the job packing_fraction-0.3_seed-1, which is not done");
  folder.succeed("sweep p.toml -o exported --export snakemake -q");
  EXPECT_THAT(folder.read("exported/Snakefile"),
              HasSubstr("\"packing_fraction-0.4_seed-1\": \"packing_fraction-0.3_seed-1\""));
  folder.expect_refusal("sweep p.toml -o x --set sweep.ladder=seed", 2,
                        "key 'sweep.ladder' is \"seed\", but must be a key of [sweep.grid]");
}

}  // namespace
}  // namespace vitrel
