// States from elsewhere: files of other programs, and particles in the parameter file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/io/h5md.h"
#include "tests/app/program.h"

namespace vitrel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing_program::differing_datasets;
using testing_program::expect_refusal;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using testing_program::succeed;
using testing_program::summary_of;
using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* three_ellipses =
    "x,y,angle,a,b,box_x,box_y\n"
    "0,0,0,1,0.5,6,6\n"
    "2.5,0.1,0.3,1,0.5,6,6\n"
    "0,2,1.2,1,0.5,6,6\n";
const std::string run_in_plane =
    "[dynamics]\nequilibration = 0\nduration = 4\n[output]\nsamples.interval = 1\n";

TEST(OwnStates, AShortTableStartsPreparationAndRun) {
  const Folder folder("from_csv");
  folder.write("mine.csv", three_ellipses);
  folder.write("p.toml", run_in_plane);
  const Json ran = summary_of(folder, {"run", "p.toml", "--from", "mine.csv", "-o", "run.h5"});
  EXPECT_EQ(ran["particles"], 3);
  EXPECT_NEAR(ran["packing_fraction"], 3 * M_PI * 0.5 / 36, 1e-15);
  const Configuration2 first = TrajectoryReader(folder / "run.h5").read<2>(0);
  EXPECT_EQ(first.position[1], Vec2(2.5, 0.1));
  EXPECT_EQ(first.angle[2], 1.2);
  EXPECT_EQ(first.mass[0], 0.5);
  EXPECT_THAT(TrajectoryReader(folder / "run.h5").provenance().parameters,
              AllOf(HasSubstr("particles = 3"), HasSubstr("semi_axes = [1.0, 0.5]"),
                    HasSubstr("method = \"state\"")));
  succeed(folder, {"run", VITREL_PARAMS "/own_state.toml", "--from", "mine.csv", "-o", "own.h5",
                   "-q", "--set", "dynamics.duration=1"});
  // The stages that move particles follow, if the file does not place them itself.
  folder.write("denser.toml",
               "[system]\npacking_fraction = 0.4\n[[prepare.stage]]\nmethod = \"swell\"\n");
  const Json denser =
      summary_of(folder, {"prepare", "denser.toml", "--from", "mine.csv", "-o", "denser.h5"});
  EXPECT_NEAR(denser["packing_fraction"], 0.4, 1e-12);
  folder.write("other.toml", "[[prepare.stage]]\nmethod = \"insert\"\n");
  const Json same =
      summary_of(folder, {"prepare", "other.toml", "--from", "mine.csv", "-o", "same.h5"});
  EXPECT_EQ(same["packing_fraction"], ran["packing_fraction"]);
  // The same as a stage of the parameter file, relative to that.
  fs::create_directory(folder / "below");
  folder.write("below/stage.toml",
               "[system]\npacking_fraction = 0.4\n[[prepare.stage]]\nmethod = \"state\"\n"
               "file = \"../mine.csv\"\n[[prepare.stage]]\nmethod = \"swell\"\n");
  succeed(folder, {"prepare", "below/stage.toml", "-o", "stage.h5", "-q"});
  EXPECT_THAT(differing_datasets(folder / "stage.h5", folder / "denser.h5"), testing::IsEmpty());
}

/// A run of two species in two or three dimensions, with velocities.
void write_run(const Folder& folder, int dimension) {
  const std::string shape = dimension == 2 ? "aspect_ratio = 2" : "semi_axes = [1.2, 1.0, 0.7]";
  folder.write("p.toml", "[system]\nparticles = 20\npacking_fraction = 0.2\ndimension = " +
                             std::to_string(dimension) + "\n[[species]]\nname = \"A\"\n" + shape +
                             "\nfraction = 0.5\n[[species]]\nname = \"B\"\naspect_ratio = 1.5\n"
                             "size = 0.6\nfraction = 0.5\n[[prepare.stage]]\nmethod = \"insert\"\n"
                             "packing_fraction = 0.2\n" +
                             run_in_plane);
  succeed(folder, {"run", "p.toml", "-o", "run.h5", "-q"});
}

class RoundTrip : public testing::TestWithParam<int> {};

TEST_P(RoundTrip, TextsAreLossless) {
  const Folder folder("round_trip_" + std::to_string(GetParam()));
  write_run(folder, GetParam());
  for (const std::string format : {"xyz", "csv"}) {
    succeed(folder, {"export", "run.h5", "--to", format, "-o", "once." + format, "-q"});
    succeed(folder, {"export", "once." + format, "--to", format, "-o", "twice." + format, "-q"});
    EXPECT_EQ(folder.read("once." + format), folder.read("twice." + format)) << format;
    // All commands see the same run.
    const Json check = summary_of(folder, {"check", "once." + format});
    EXPECT_EQ(check["frames"], 5);
    EXPECT_EQ(check["smallest_gap"], summary_of(folder, {"check", "run.h5"})["smallest_gap"]);
    Json of_copy = summary_of(folder, {"analyze", "once." + format, "-o", "copy.h5"});
    Json of_run = summary_of(folder, {"analyze", "run.h5", "-o", "results.h5"});
    for (const char* key : {"packing_fraction", "frames", "duration", "translational_energy"})
      EXPECT_EQ(of_copy[key], of_run[key]) << key;
  }
}

TEST_P(RoundTrip, AStateOfH5mdKeepsAllBits) {
  const Folder folder("round_trip_h5md_" + std::to_string(GetParam()));
  write_run(folder, GetParam());
  folder.write("none.toml", "# all defaults\n");
  succeed(folder, {"prepare", "none.toml", "--from", "run.h5", "-o", "once.h5", "-q"});
  succeed(folder, {"prepare", "none.toml", "--from", "once.h5", "-o", "twice.h5", "-q"});
  EXPECT_THAT(differing_datasets(folder / "once.h5", folder / "twice.h5"), testing::IsEmpty());
  for (const std::string format : {"xyz", "csv"}) {
    succeed(folder, {"export", "run.h5", "--to", format, "-o", "run." + format, "-q"});
    succeed(folder,
            {"prepare", "none.toml", "--from", "run." + format, "-o", format + ".h5", "-q"});
    EXPECT_THAT(differing_datasets(folder / "once.h5", folder / (format + ".h5")),
                testing::IsEmpty())
        << format;
  }
}

TEST_P(RoundTrip, GsdIsGoodToSinglePrecision) {
  const Folder folder("round_trip_gsd_" + std::to_string(GetParam()));
  write_run(folder, GetParam());
  succeed(folder, {"export", "run.h5", "--to", "gsd", "-q"});
  folder.write("none.toml", "# all defaults\n");
  succeed(folder, {"prepare", "none.toml", "--from", "run.gsd", "-o", "gsd.h5", "-q"});
  succeed(folder, {"prepare", "none.toml", "--from", "run.h5", "-o", "h5.h5", "-q"});
  const auto expected = testing_program::all_datasets(folder / "h5.h5");
  const auto found = testing_program::all_datasets(folder / "gsd.h5");
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
  const Folder folder("digits");
  folder.write("mine.csv", three_ellipses);
  folder.write("p.toml", run_in_plane + "[system]\nparticles = 3\n");
  // φ = 0.130899693…
  const auto start = [&](const std::string& setting) {
    return run(folder.path(), {"run", "p.toml", "--from", "mine.csv", "-o", "a.h5", "--dry-run",
                               "--set", setting});
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
  const Folder folder("bad_files");
  folder.write("p.toml", run_in_plane);
  const auto refused = [&](const std::string& name, const std::string& text,
                           const std::string& complaint) {
    folder.write(name, text);
    expect_refusal(run(folder.path(), {"check", name, "-q"}), 3, complaint);
    expect_refusal(run(folder.path(), {"run", "p.toml", "--from", name, "-o", "a.h5", "-q"}), 3,
                   complaint);
    EXPECT_FALSE(fs::exists(folder / "a.h5"));
  };
  const std::string header = "x,y,angle,a,b,box_x,box_y\n";
  refused("a.csv", header + "0,0,0,1,0.5,6,6\n1,up,0,1,0.5,6,6\n",
          "a.csv:3: y is \"up\", but should be a finite number");
  refused("a.csv", "step," + header + "1e300,0,0,0,1,0.5,6,6\n",
          "a.csv:2: step is 1e+300, but should be a whole number");
  refused("a.csv", header + "0,0,0,1,0.5,6\n", "a.csv:2: has 6 cells, but there are 7 columns");
  refused("a.csv", "x,y,angle,b,box_x,box_y\n0,0,0,1,6,6\n",
          "a.csv:1: there is a column b, but none named a");
  refused("a.csv", "x,y,a,b,box_x,box_y\n0,0,1,0.5,6,6\n",
          "a.csv: frame 0: has no angles, but particle 0 is not round");
  refused("a.csv", "x,y,angle,a,b\n0,0,0,1,0.5\n", "a.csv: frame 0: has no box");
  refused("a.csv", header + "0,0,0,1,0,6,6\n",
          "a.csv: frame 0: particle 0 has the semi-axes 1, 0, but should have a ≥ b > 0");
  for (const auto& [pbc, direction] : {std::pair("F F F", "x"), {"f t t", "x"}, {"1 0 1", "y"}})
    refused(
        "a.xyz",
        fmt::format("1\nLattice=\"6 0 0 0 6 0 0 0 6\" pbc=\"{}\" Properties=pos:R:3:radius:R:1\n"
                    "1 1 1 1\n",
                    pbc),
        fmt::format("a.xyz:2: pbc=\"{}\": the box is not periodic along {}", pbc, direction));
  refused("a.xyz",
          "2\nLattice=\"6 0 0 0 6 0 0 0 6\" pbc=\"T T F\" Properties=pos:R:3:radius:R:1\n"
          "1 1 1 1\n4 4 4 1\n",
          "a.xyz: frame 0: the system is two-dimensional, but the z of its particles differ by 3");
  refused("a.csv", "name,value\nx,1\n",
          "a.csv:1: none of the columns \"name\", \"value\" is named x; [[import.columns]]");
  refused("a.csv", "a word\n", "a.csv: is not recognised as H5MD, GSD, extended XYZ,");
  const std::string keys =
      "Lattice=\"6 0 0 0 6 0 0 0 6\" Properties=species:S:1:pos:R:3:radius:R:1\n";
  refused("a.xyz", "2\n" + keys + "A 0 0 0 1\n", "a.xyz:3: the file ends before particle 1 of 2");
  refused("a.xyz", "1\nProperties=species:S:1\nA\n",
          "a.xyz:2: none of the columns \"species\" is named x");
  refused("a.xyz", "1\nProperties=pos:R\nA 0 0 0 1\n", "a.xyz:2: should have Properties=name:type");
  refused("a.xyz", "1\n" + keys + "A 0 0 0 1\n2\n" + keys + "A 0 0 0 1\nA 3 3 3 1\n",
          "a.xyz: frame 1: has other particles than frame 0");
  refused("bad.h5", std::string("\0\1\2", 3), "it is binary, and none of these begins so");
  expect_refusal(run(folder.path(), {"check", "none.csv", "-q"}), 3, "none.csv: cannot open");
  // A GSD file with its end cut off.
  write_run(folder, 2);
  succeed(folder, {"export", "run.h5", "--to", "gsd", "-q"});
  const std::string whole = folder.read("run.gsd");
  refused("cut.gsd", whole.substr(0, whole.size() / 2), "cut.gsd: is truncated or damaged");
}

TEST(OwnStates, OverlapsAreNamedOrShrunk) {
  const Folder folder("overlapping");
  folder.write("mine.csv",
               "x,y,radius,box_x,box_y\n-2,0,1,8,8\n0,0,1,8,8\n1.99,0,1,8,8\n0,3,1,8,8\n");
  folder.write("p.toml", run_in_plane);
  const std::vector<std::string> start = {"run", "p.toml", "--from", "mine.csv", "-o", "a.h5"};
  expect_refusal(run(folder.path(), start), 4,
                 "mine.csv: has 1 overlapping pair(s), the deepest of particles 1 and 2, image (0, "
                 "0), which would touch if scaled by 0.995;");
  EXPECT_THAT(run(folder.path(), {"check", "mine.csv"}).errors,
              HasSubstr("particles 1 and 2, image (0, 0), would touch if scaled by 1 − 0.005"));
  std::vector<std::string> shrinking = start;
  shrinking.push_back("--shrink");
  const Outcome shrunk = run(folder.path(), shrinking);
  EXPECT_EQ(shrunk.code, 0) << shrunk.errors;
  EXPECT_THAT(shrunk.errors, HasSubstr("mine.csv: all particles are scaled by 1 − 0.005"));
  const Configuration2 first = TrajectoryReader(folder / "a.h5").read<2>(0);
  EXPECT_NEAR(first.shape[3].a, 0.995, 1e-15);
  EXPECT_EQ(run(folder.path(), {"check", "a.h5", "-q"}).code, 0);
  // The same command finds it complete, and goes on.
  EXPECT_THAT(run(folder.path(), shrinking).errors, HasSubstr("complete already"));
}

TEST(OwnStates, ShapesMayComeFromTheParameters) {
  const Folder folder("shapes_elsewhere");
  folder.write("mine.xyz",
               "3\nLattice=\"9 0 0 0 9 0 0 0 9\" Properties=species:S:1:pos:R:3:orientation:R:4 "
               "Time=0\nrod 1 1 1 0 0 0 1\nball 5 5 5 0 0 0 1\nrod 1 5 1 0 0 0 1\n"
               "3\nLattice=\"9 0 0 0 9 0 0 0 9\" Properties=species:S:1:pos:R:3:orientation:R:4 "
               "Time=2\nrod 1 1 2 0 0 0 1\nball 5 5 5 0 0 0 1\nrod 1 5 1 0 0 0 1\n");
  folder.write("p.toml",
               "[system]\ndimension = 3\n[[species]]\nname = \"ball\"\naspect_ratio = 1\nsize = "
               "1.5\nfraction = 0.333333333333333\n[[species]]\nname = \"rod\"\nsemi_axes = [2, "
               "0.5, 0.5]\nfraction = 0.666666666666667\nmass = 7\n" +
                   run_in_plane);
  expect_refusal(
      run(folder.path(), {"check", "mine.xyz", "-q"}), 3,
      "mine.xyz: frame 0: has no sizes: it has no property aspherical_shape or radius, and "
      "neither [[import.species]] nor [[species]] gives diameter or semi-axes of ball, "
      "rod");
  const Json check = summary_of(folder, {"check", "mine.xyz", "--params", "p.toml"});
  const double volume = 4 * M_PI / 3 * (1.5 * 1.5 * 1.5 + 2 * 2 * 0.25);
  EXPECT_NEAR(check["packing_fraction"], volume / 729, 1e-15);
  const Outcome analysed =
      run(folder.path(), {"analyze", "mine.xyz", "--params", "p.toml", "-o", "r.h5"});
  EXPECT_EQ(analysed.code, 0);
  EXPECT_THAT(analysed.errors,
              HasSubstr("mine.xyz: motion is left out: box crossings are unknown: it has no "
                        "property map_shift; if no particle moves by more than half a box length "
                        "between frames, import.unwrap = \"nearest\" counts them"));
  succeed(folder, {"run", "p.toml", "--from", "mine.xyz", "-o", "run.h5", "-q"});
  const Configuration3 first = TrajectoryReader(folder / "run.h5").read<3>(0);
  EXPECT_THAT(first.species_names, testing::ElementsAre("ball", "rod"));
  EXPECT_THAT(first.species, testing::ElementsAre(1, 0, 1));
  EXPECT_EQ(first.mass[0], 7);
  // In the last frame, with the box centred at the origin.
  EXPECT_EQ(first.position[0], Vec3(-3.5, -3.5, -2.5));
}

TEST(OwnStates, HarmlessDifferencesOfATextAreRead) {
  const Folder folder("harmless");
  folder.write("right.csv", "x,y,angle,a,b,box_x,box_y\n-2,-2,1.5707963267948966,1,0.5,6,6\n");
  const Json right = summary_of(folder, {"check", "right.csv"});
  const std::string properties =
      "Properties = species:S:1:pos:R:3:orientation:R:4:aspherical_shape:R:3\n"
      "A 1.0D0 1 1e-7 0 0 0 1 0.5D0 1.0d+00 1\n";
  for (const char* lattice : {"\"6 0 0 0 6 0 0 0 6\"", "\"6.,0.,0., 0.,6.,0., 0.,0.,6.\"",
                              "[[6, 0, 0], [0, 6, 0], [0, 0, 6]]"}) {
    SCOPED_TRACE(lattice);
    folder.write("a.xyz", fmt::format("1\nLattice = {} pbc = \"T T F\" {}", lattice, properties));
    const Outcome found = run(folder.path(), {"check", "a.xyz", "--json"});
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
  const std::vector<std::string> analyze = {"analyze", "flight.csv", "-o",
                                            "r.h5",    "--set",      "import.unwrap=\"nearest\""};
  folder.write("flight.csv", flight(4, 8));
  const Outcome counted = run(folder.path(), analyze);
  ASSERT_EQ(counted.code, 0) << counted.errors;
  EXPECT_THAT(counted.errors,
              AllOf(HasSubstr("the longest step is 0.4 box lengths along x, of particle 0"),
                    HasSubstr("above 0.25, longer steps that were taken for shorter ones cannot be "
                              "excluded")));
  const testing_program::Datasets found = testing_program::all_datasets(folder / "r.h5");
  const std::vector<double>& msd = found.at("/displacements_all/msd");
  for (std::size_t k = 0; k < msd.size(); ++k) EXPECT_NEAR(msd[k], 16. * (k + 1) * (k + 1), 1e-9);
  // Steps of 6 look like steps of −4; the velocities tell.
  folder.write("flight.csv", flight(6, 8));
  expect_refusal(run(folder.path(), analyze), 3,
                 "frame 1: particle 0 has the same velocity as in the frame before and flew by (6, "
                 "0), but its nearest image moved by (-4, 0)");
}

// Up to the precision of the format: GSD has floats, and no angles that count turns.
TEST(OwnStates, RunsInOtherFormatsAreAnalysedLikeTheirOwn) {
  const Folder folder("analyse_other_formats");
  folder.write("p.toml", "[system]\nparticles = 20\n" + run_in_plane + "velocities = true\n");
  succeed(folder, {"run", "p.toml", "-o", "run.h5", "-q", "--set", "output.samples.interval=0.1"});
  succeed(folder, {"analyze", "run.h5", "-o", "right.h5", "-q"});
  const testing_program::Datasets right = testing_program::all_datasets(folder / "right.h5");
  for (const auto& [format, tolerance] : {std::pair("csv", 0.), {"xyz", 0.}, {"gsd", 1e-5}}) {
    const std::string file = std::string("run.") + format, results = file + ".results.h5";
    succeed(folder, {"export", "run.h5", "--to", format, "-o", file, "-q"});
    succeed(folder, {"analyze", file, "-o", results, "-q"});
    const testing_program::Datasets found = testing_program::all_datasets(folder / results);
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
  const Folder folder("sizes_in_gsd");
  folder.write(
      "p.toml",
      "[system]\nparticles = 12\npacking_fraction = 0.3\n"
      "[[species]]\nname = \"L\"\nfraction = 0.5\naspect_ratio = 1\nsize = { distribution = "
      "\"gaussian\", mean = 1.0, standard_deviation = 0.1 }\n"
      "[[species]]\nname = \"E\"\nfraction = 0.5\naspect_ratio = 2\n" +
          run_in_plane);
  succeed(folder, {"run", "p.toml", "-o", "run.h5", "-q"});
  succeed(folder, {"export", "run.h5", "--to", "gsd", "-q"});
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
  const Folder folder("polydisperse");
  folder.write("mine.csv", "x,y,radius,box_x,box_y\n-2,0,1,8,8\n0.5,0,0.8,8,8\n0,3,0.9,8,8\n");
  folder.write("p.toml", run_in_plane);
  succeed(folder, {"run", "p.toml", "--from", "mine.csv", "-o", "a.h5", "-q"});
  EXPECT_THAT(TrajectoryReader(folder / "a.h5").provenance().parameters,
              HasSubstr("distribution = \"uniform\", low = 0.8, high = 1.0"));
  succeed(folder, {"run", "p.toml", "--from", "a.h5", "-o", "b.h5", "-q"});
}

TEST(OwnStates, TheTwoEllipsesOfTheThesisMeetWhenTheyShould) {
  const Folder folder("two_ellipses");
  const std::string scene = VITREL_PARAMS "/two_ellipses.toml";
  const auto collisions = [&](const std::string& duration) {
    return summary_of(
        folder, {"run", scene, "-o", duration + ".h5", "--set", "dynamics.duration=" + duration,
                 "--set", "output.samples.interval=0.01"})["collisions"];
  };
  EXPECT_EQ(collisions("0.0847223858218"), 0);
  EXPECT_EQ(collisions("0.084722385822"), 1);
  const Json whole = summary_of(folder, {"run", scene, "-o", "two.h5"});
  EXPECT_EQ(whole["collisions"], 1);
  EXPECT_LT(whole["energy_drift"], 1e-14);
}

TEST(OwnStates, TheSoftPairLeavesAsInTheArticle) {
  const Folder folder("soft_pair");
  succeed(folder, {"run", VITREL_PARAMS "/soft_pair.toml", "-o", "pair.h5", "-q"});
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
  const auto refused = [&](const std::string& more, const std::string& complaint) {
    folder.write("p.toml", run_in_plane + stage + more);
    expect_refusal(run(folder.path(), {"run", "p.toml", "-o", "a.h5", "-q"}), 2, complaint);
  };
  refused("angles = [0]\n",
          "p.toml:10:10: key 'prepare.stage.0.angles' has 1 entries, but "
          "positions has 2");
  refused("velocities = [[1, 0], [1]]\n",
          "velocities' has 1 numbers for particle 1, but must have 2");
  refused("quaternions = [[1, 0, 0, 0], [1, 0, 0, 0]]\n", "is for three dimensions; give angles");
  refused("file = \"a.csv\"\n", "'prepare.stage.0.file' excludes positions");
  refused("semi_axes = [[1, 0.5], [1, 2]]\n", "particle 1 has the semi-axes 1, 2");
  folder.write("p.toml", "[[prepare.stage]]\nmethod = \"state\"\n");
  expect_refusal(run(folder.path(), {"prepare", "p.toml", "-o", "a.h5", "-q"}), 2,
                 "'prepare.stage.0.file' is missing; give a file, or positions");
}

TEST(OwnStates, APreparationFromAStateContinuesAfterAStop) {
  const Folder folder("continued");
  folder.write("mine.csv", three_ellipses);
  folder.write("p.toml",
               "[[prepare.stage]]\nmethod = \"sample\"\nsweeps = 3000\n[prepare]\n"
               "quality_sweeps = 10\n");
  const auto command = [](const std::string& output) {
    return std::vector<std::string>{"prepare", "p.toml", "--from", "mine.csv", "-o", output, "-q"};
  };
  succeed(folder, command("whole.h5"));
  std::vector<std::string> stopped = command("parts.h5");
  stopped.insert(stopped.end(), {"--wall-time", "1e-6"});
  int stops = 0;
  while (run(folder.path(), stopped).code == 5 && stops < 3) ++stops;
  EXPECT_GT(stops, 0);
  fs::remove(folder / "mine.csv");
  if (!fs::exists(folder / "parts.h5")) succeed(folder, command("parts.h5"));
  EXPECT_THAT(differing_datasets(folder / "whole.h5", folder / "parts.h5"), testing::IsEmpty());
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
    const std::string sweep = end.substr(10, 4);
    const Json job = summary_of(folder, {"sweep", "p.toml", "-o", sweep})["jobs"][0];
    EXPECT_EQ(job["run"]["packing_fraction"], job["prepare"]["packing_fraction"]) << end;
  }
}

TEST(OwnStates, ADensityLadderStartsFromTheDensityBefore) {
  const Folder folder("ladder");
  folder.write("p.toml",
               "[system]\nparticles = 20\n[[prepare.stage]]\nmethod = \"insert\"\n"
               "[[prepare.stage]]\nmethod = \"swell\"\n" +
                   run_in_plane +
                   "[sweep]\nladder = \"system.packing_fraction\"\n[sweep.grid]\n"
                   "\"system.packing_fraction\" = [0.3, 0.4, 0.5]\n\"system.seed\" = [1, 2]\n");
  const Json sweep = summary_of(folder, {"sweep", "p.toml", "-o", "sweep", "-j", "2"});
  ASSERT_EQ(sweep["jobs"].size(), 6u);
  const auto job = [&](const std::string& phi) {
    return folder / ("sweep/packing_fraction-" + phi + "_seed-2");
  };
  for (const auto& [before, phi] : {std::pair("0.3", "0.4"), {"0.4", "0.5"}}) {
    const TrajectoryReader state(job(phi) / "state.h5");
    EXPECT_THAT(state.provenance().parameters,
                HasSubstr("packing_fraction-" + std::string(before) + "_seed-2/run.h5"));
    EXPECT_NEAR(packing_fraction(state.read<2>(0)), std::stod(phi), 1e-12);
  }
  // By hand: the second state from the end of the first run.
  folder.write(
      "second.toml",
      "[system]\npacking_fraction = 0.4\nseed = 2\n[[prepare.stage]]\nmethod = \"swell\"\n");
  succeed(folder, {"prepare", "second.toml", "--from", (job("0.3") / "run.h5").string(), "-o",
                   "second.h5", "-q"});
  EXPECT_THAT(differing_datasets(folder / "second.h5", job("0.4") / "state.h5"),
              testing::IsEmpty());
  // A single job waits for no other.
  expect_refusal(
      run(folder.path(),
          {"sweep", "p.toml", "-o", "single", "--job", "packing_fraction-0.4_seed-1", "-q"}),
      2, "starts from the end of the job packing_fraction-0.3_seed-1, which is not done");
  succeed(folder, {"sweep", "p.toml", "-o", "exported", "--export", "snakemake", "-q"});
  EXPECT_THAT(folder.read("exported/Snakefile"),
              HasSubstr("\"packing_fraction-0.4_seed-1\": \"packing_fraction-0.3_seed-1\""));
  expect_refusal(run(folder.path(), {"sweep", "p.toml", "-o", "x", "--set", "sweep.ladder=seed"}),
                 2, "key 'sweep.ladder' is \"seed\", but must be a key of [sweep.grid]");
}

}  // namespace
}  // namespace vitrel
