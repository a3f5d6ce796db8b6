#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <map>
#include <numbers>

#include "core/error.h"
#include "core/io/foreign/foreign_formats.h"
#include "core/io/h5md.h"
#include "tests/support/foreign_files.h"

namespace vitrel {
namespace {

using testing::HasSubstr;

class Import : public ForeignFiles {
 protected:
  /// H5MD with these particles at one time; `more` adds to the group of particles.
  std::filesystem::path h5md(const std::string& name,
                             const std::function<void(h5::Group&)>& more) const {
    h5::File output = h5::File::create(file(name));
    h5::Group root = output.root();
    h5::Group particles = root.create_group("particles").create_group("any");
    more(particles);
    output.close();
    return file(name);
  }

  static void expect_refusal(const std::filesystem::path& path, const std::string& message,
                             const KnownSystem& known = {}) {
    EXPECT_THAT(refusal(path, known), HasSubstr(message)) << path;
  }
  Configuration3 read(const std::string& name, const std::string& content,
                      const KnownSystem& known = {}) const {
    return TrajectoryReader(text(name, content), known).read<3>(0);
  }
};

void add_series(h5::Group& particles, const std::string& name, const h5::Shape& frame,
                std::size_t frames, const std::vector<double>& values) {
  h5::Group group = particles.create_group(name);
  h5::Shape shape = frame;
  shape.insert(shape.begin(), frames);
  group.create_array<double>("value", shape, values);
  std::vector<double> steps(frames);
  for (std::size_t k = 0; k < frames; ++k) steps[k] = static_cast<double>(k);
  group.create_array<double>("step", {frames}, steps);
  group.create_array<double>("time", {frames}, steps);
}

void add(h5::Group& particles, const std::string& name, const h5::Shape& shape,
         const std::vector<double>& values) {
  particles.create_array<double>(name, shape, values);
}

void add_two_disks(h5::Group& particles, const std::vector<double>& positions) {
  h5::Group box = particles.create_group("box");
  add(box, "edges", {2}, {10, 10});
  add(particles, "semiaxes", {2, 2}, {1, 1, 1, 1});
  add_series(particles, "position", {2, 2}, 2, positions);
}

/// Two frames of two disks; the least that H5MD can say.
void two_disks(h5::Group& particles) {
  add_two_disks(particles, {-3, 0, 3, 0, -3, 1, 3, 1});
}

/// Adds the same in a box of this boundary along y.
std::function<void(h5::Group&)> two_disks_in_a_box(const std::string& boundary) {
  return [=](h5::Group& particles) {
    two_disks(particles);
    h5::Group box = particles.group("box");
    box.set_attribute("boundary", std::array<std::string, 2>{"periodic", boundary}, 8);
  };
}

KnownSystem of_dimension(int dimension) {
  KnownSystem known;
  known.dimension = dimension;
  return known;
}

constexpr const char* small_xyz =
    "2\nLattice=\"10 0 0 0 10 0 0 0 10\" Properties=pos:R:3:radius:R:1\n1 1 1 1\n5 5 5 1\n"
    "2\nLattice=\"10 0 0 0 10 0 0 0 10\" Properties=pos:R:3:radius:R:1\n1 1 2 1\n5 5 5 1\n";
constexpr const char* small_csv =
    "frame,x,y,radius,box_x,box_y\n0,0,0,1,9,9\n0,3,0,1,9,9\n1,0,1,1,9,9\n1,3,0,1,9,9\n";

std::string dump_frame(int step, const std::string& columns, const std::string& atoms) {
  return fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n-5 5\n0 10\n2 12\n"
      "ITEM: ATOMS {}\n{}",
      step, columns, atoms);
}
const std::string small_dump = dump_frame(0, "x y z radius", "0 1 3 1\n3 3 9 1\n");

std::string data_file(const std::string& atoms) {
  return "title\n2 atoms\n0 9 xlo xhi\n0 9 ylo yhi\n0 9 zlo zhi\nAtoms # sphere\n\n" + atoms;
}

TEST_F(Import, UnitsAreThoseOfTheFile) {
  const auto units = [](const std::filesystem::path& path, const KnownSystem& known = {}) {
    const TrajectoryReader reader(path, known);
    return std::pair(reader.units()->length, reader.units()->time);
  };
  const std::string unknown = "(unit of length)";
  EXPECT_EQ(units(text("a.csv", small_csv)), std::pair(unknown, std::string("frames")));
  const auto path = text("b.csv",
                         "time [s],x [um],y [um],radius [um],box_x [um],box_y [um]\n0,0,0,1,9,9\n"
                         "1,0,0,1,9,9\n");
  EXPECT_EQ(units(path), std::pair(std::string("um"), std::string("s")));
  KnownSystem known;
  known.import.length_unit = 0.5;
  EXPECT_EQ(units(path, known).first, unknown);
  EXPECT_EQ(units(text("a.dump", small_dump)), std::pair(unknown, std::string("steps")));
  known = {};
  known.import.time_per_step = 0.1;
  EXPECT_EQ(units(file("a.dump"), known).second, "(unit of time)");
}

// What a file does not have is replaced by nothing that its import does not say.
TEST_F(Import, EveryDefaultIsSaid) {
  const std::string bare = "velocities (energies are left out), box crossings (motion is left out)";
  const std::string natural = "masses (in proportion to the area, 1 where a b = 1)";
  const std::string in_space = "masses (in proportion to the volume, 1 where a b c = 1)";
  const std::string unstated = "boundaries (periodic, which this format cannot state)";
  const std::string one_species = "species (all are \"A\")";
  const std::string frames = "times (they are counted in frames)";
  const std::string steps = "times (they are counted in steps)";
  EXPECT_EQ(report(h5md("a.h5", two_disks)).at("absent"),
            fmt::format("boundaries (periodic), {}, {}, {}", one_species, natural, bare));
  EXPECT_EQ(
      report(text("a.xyz", small_xyz)).at("absent"),
      fmt::format("boundaries (periodic), {}, {}, {}, {}", one_species, in_space, bare, frames));
  EXPECT_EQ(report(text("a.csv", small_csv)).at("absent"),
            fmt::format("{}, {}, {}, {}, {}", unstated, one_species, natural, bare, frames));
  const std::string dump = small_dump + dump_frame(9, "x y z radius", "0 1 4 1\n3 3 9 1\n");
  EXPECT_EQ(report(text("a.dump", dump)).at("absent"),
            fmt::format("{}, {}, {}, {}", one_species, in_space, bare, steps));
  const std::string data = data_file("2 1 1.0 1.0 1 2 3\n1 1 1.0 1.0 4 5 6\n");
  EXPECT_EQ(report(text("a.data", data)).at("absent"),
            unstated + ", velocities (energies are left out)");
  for (const char* name : {"a.h5", "a.xyz", "a.csv", "a.dump", "a.data"})
    EXPECT_FALSE(report(file(name)).contains("converted")) << name;
}

TEST_F(Import, ContentTellsTheFormat) {
  const std::map<std::string, std::filesystem::path> files = {
      {"H5MD", h5md("1", two_disks)},
      {"extended XYZ", text("2", small_xyz)},
      {"CSV", text("3", small_csv)},
      {"LAMMPS dump", text("4", small_dump)},
      {"LAMMPS data", text("5", "a\n\n 2 atoms\n")}};
  for (const auto& [name, path] : files) EXPECT_EQ(format_of(path, {}).name, name);
  for (const ForeignFormat* format : foreign_formats())
    EXPECT_THAT(foreign_format_names(), HasSubstr(format->name));
  expect_refusal(text("6", "some words\n"), "it begins with \"some words\"");
  expect_refusal(text("7", ""), "is empty");
  KnownSystem known;
  known.import.format = "XML";
  EXPECT_THROW(format_of(files.at("CSV"), known.import), UserError);
  known.import.format = "CSV";
  EXPECT_EQ(report(text("8", "# a remark\n" + std::string(small_csv)), known).at("format"), "CSV");
}

// A conversion of other numbers is undefined, or silently another place.
TEST_F(Import, BoxCrossingsAreWholeNumbers) {
  const KnownSystem plane = of_dimension(2);
  for (const double wrong : {0.5, 1e18}) {
    const auto with_images = [&](h5::Group& particles) {
      two_disks(particles);
      add_series(particles, "image", {2, 2}, 2, {0, 0, 0, 0, 0, wrong, 0, 0});
    };
    const std::filesystem::path files[] = {
        h5md("a.h5", with_images),
        text("a.csv", fmt::format("x,y,image_x,image_y,radius,box_x,box_y\n"
                                  "-3,0,0,{},1,10,10\n3,0,0,0,1,10,10\n",
                                  wrong)),
        text("a.dump", dump_frame(0, "x y z radius ix iy iz",
                                  fmt::format("0 1 3 1 0 {} 0\n3 3 9 1 0 0 0\n", wrong))),
        text("a.data",
             data_file(fmt::format("2 1 1.0 1.0 1 2 3 0 {} 0\n1 1 1.0 1.0 4 5 6 0 0 0\n", wrong)))};
    for (const auto& path : files) expect_refusal(path, "image", plane);
  }
}

// The same two particles, exchanged in the second frame.
TEST_F(Import, EveryFormatFollowsIds) {
  const auto shuffled_h5md = [](h5::Group& particles) {
    add_two_disks(particles, {-3, 0, 3, 0, 3, 0, -3, 0});
    add_series(particles, "id", {2}, 2, {4, 7, 7, 4});
  };
  const std::string xyz =
      "Lattice=\"10 0 0 0 10 0 0 0 1\" pbc=\"T T F\" Properties=id:I:1:pos:R:3:radius:R:1\n";
  const std::string columns = "id xs ys zs radius";
  const std::filesystem::path files[] = {
      h5md("a.h5", shuffled_h5md),
      text("a.csv",
           "frame,id,x,y,radius,box_x,box_y\n0,4,-3,0,1,10,10\n0,7,3,0,1,10,10\n"
           "1,7,3,0,1,10,10\n1,4,-3,0,1,10,10\n"),
      text("a.xyz", fmt::format("2\n{0}4 2 5 0 1\n7 8 5 0 1\n2\n{0}7 8 5 0 1\n4 2 5 0 1\n", xyz)),
      text("a.dump", dump_frame(0, columns, "4 0.2 0.5 0 1\n7 0.8 0.5 0 1\n") +
                         dump_frame(1, columns, "7 0.8 0.5 0 1\n4 0.2 0.5 0 1\n"))};
  for (const auto& path : files) {
    const TrajectoryReader reader(path, of_dimension(2));
    ASSERT_EQ(reader.frames(), 2u) << path;
    for (std::uint64_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(reader.read(k).position[0].x(), -3, 1e-14) << path << k;
      EXPECT_NEAR(reader.read(k).position[1].x(), 3, 1e-14) << path << k;
    }
  }
  const std::filesystem::path other =
      text("b.csv", "frame,id,x,y,radius,box_x,box_y\n0,1,0,0,1,9,9\n1,2,0,0,1,9,9\n");
  expect_refusal(other, "frame 1: has other particles than frame 0");
}

TEST_F(Import, EveryFormatRefusesABoxThatIsNotPeriodic) {
  expect_refusal(h5md("a.h5", two_disks_in_a_box("none")),
                 "boundary of particles/any/box is periodic, none: the box is not periodic "
                 "along y");
  for (const char* pbc : {"F T T", "f t t", "false true true", "0 1 1", "[F, T, T]"}) {
    SCOPED_TRACE(pbc);
    std::string xyz = small_xyz;
    xyz.insert(xyz.find(" Properties"), fmt::format(" pbc=\"{}\"", pbc));
    expect_refusal(text("a.xyz", xyz), "not periodic along x");
  }
  for (const char* letters : {"ff pp pp", "ss pp pp", "fm pp pp", "ms pp pp"}) {
    std::string dump = small_dump;
    dump.replace(dump.find("pp pp pp"), 8, letters);
    expect_refusal(text("a.dump", dump),
                   fmt::format("BOX BOUNDS {}: the box is not periodic along x", letters));
  }
}

TEST_F(Import, AFlatBoxIsNotTakenForSpace) {
  const std::string flat =
      "2\nLattice=\"10 0 0 0 10 0 0 0 1\" Properties=pos:R:3:radius:R:1\n"
      "1 1 0.5 1\n5 5 0.5 1\n";
  expect_refusal(text("a.xyz", flat), "pbc=\"T T F\"");
  const KnownSystem plane = of_dimension(2);
  EXPECT_EQ(TrajectoryReader(file("a.xyz"), plane).dimension(), 2);
  std::string lower = flat;
  lower.replace(lower.find("0 0 0 1\""), 7, "0 0 0 8");
  EXPECT_EQ(TrajectoryReader(text("b.xyz", lower)).dimension(), 3);
  // The box is in the unit of the file, sizes known beforehand are in that of the results.
  KnownSystem micro;
  micro.import.length_unit = 1e-6;
  micro.species = {{"A", Vec3(1, 1, 1)}};
  EXPECT_EQ(TrajectoryReader(text("d.xyz",
                                  "2\nLattice=\"9e-6 0 0 0 9e-6 0 0 0 8e-6\" "
                                  "Properties=pos:R:3\n1e-6 1e-6 0 \n5e-6 5e-6 0\n"),
                             micro)
                .dimension(),
            3);
  std::string steep = flat;
  steep.replace(steep.find("5 5 0.5"), 7, "5 5 0.6");
  expect_refusal(text("c.xyz", steep), "z of its particles differ by 0.1", plane);
}

TEST_F(Import, OfSeveralGroupsOneIsNamed) {
  const std::filesystem::path path = h5md("a.h5", two_disks);
  {
    h5::File more = h5::File::open(path, h5::Access::write);
    h5::Group other = more.root().group("particles").create_group("walls");
    two_disks(other);
    more.close();
  }
  expect_refusal(path, "2 groups of particles, any, walls; import.group");
  KnownSystem known;
  known.import.group = "walls";
  EXPECT_EQ(TrajectoryReader(path, known).frames(), 2u);
  known.import.group = "floor";
  expect_refusal(path, "no group of particles floor", known);
}

TEST_F(Import, UnitsMustAgree) {
  const auto with_units = [](const char* edges, const char* positions, const char* velocities) {
    return [=](h5::Group& particles) {
      two_disks(particles);
      h5::Group box = particles.group("box"), position = particles.group("position");
      h5::Dataset of_box = box.dataset("edges"), values = position.dataset("value"),
                  times = position.dataset("time");
      of_box.set_attribute("unit", std::string(edges));
      values.set_attribute("unit", std::string(positions));
      times.set_attribute("unit", std::string("ps"));
      add_series(particles, "velocity", {2, 2}, 2, std::vector<double>(8, 1.0));
      h5::Dataset velocity = particles.group("velocity").dataset("value");
      velocity.set_attribute("unit", std::string(velocities));
    };
  };
  EXPECT_EQ(refusal(h5md("a.h5", with_units("nm", "nm", "nm ps-1"))), "read");
  EXPECT_EQ(refusal(h5md("b.h5", with_units("nm", "nm", "km/s"))), "read");
  expect_refusal(h5md("c.h5", with_units("nm", "Angstrom", "nm ps-1")),
                 "lengths should have one unit");
  expect_refusal(h5md("d.h5", with_units("nm", "nm", "angstrom/ps")), "should be in nm/ps");
  const auto table = [&](const char* header) {
    return refusal(text("a.csv", fmt::format("{}\n0,0,0,0,1,0.5,1,9,9\n", header)));
  };
  EXPECT_EQ(table("time [s],x [um],y [um],angle [rad],a,b [um],id,box_x [um],box_y [um]"), "read");
  EXPECT_THAT(table("time [s],x [um],y [um],angle [rad],a,b [um],id,box_x [nm],box_y [nm]"),
              HasSubstr("column b is in um, but column box_x in nm"));
  EXPECT_THAT(table("time [s],x [um],y [um],angle [deg],a,b [um],id,box_x,box_y"),
              HasSubstr("column angle is in deg, but should be in radians"));
  expect_refusal(h5md("e.h5", two_disks_in_a_box("open")),
                 "periodic, open, but should be \"periodic\" or \"none\"");
}

TEST_F(Import, AllPlacesOfLammpsAreTheSame) {
  const auto last = [&](const std::string& columns, const std::string& atoms) {
    return read("a.dump", dump_frame(0, columns, atoms));
  };
  const Configuration3 plain = last("x y z ix iy iz radius", "4 1 3 1 0 0 1\n0 3 9 0 0 -1 1\n");
  const Configuration3 fractions =
      last("xs ys zs ix iy iz diameter", "0.9 0.1 0.1 1 0 0 2\n0.5 0.3 0.7 0 0 -1 2\n");
  const Configuration3 unwrapped = last("xu yu zu radius", "14 1 3 1\n0 3 -1 1\n");
  const Configuration3 both =
      last("xsu ysu zsu shapex shapey shapez", "1.9 0.1 0.1 2 2 2\n0.5 0.3 -0.3 2 2 2\n");
  for (std::size_t i = 0; i < 2; ++i)
    for (const Configuration3* other : {&fractions, &unwrapped, &both}) {
      EXPECT_LT((other->unwrapped(i) - plain.unwrapped(i)).norm(), 1e-12);
      EXPECT_EQ(other->shape[i].semi_axes, plain.shape[i].semi_axes);
    }
}

TEST_F(Import, LammpsDataHaveMassesAndRotations) {
  const std::string data =
      "title\n\n2 atoms\n1 atom types\n2 ellipsoids\n-5 5 xlo xhi\n-5 5 ylo yhi\n-5 5 zlo zhi\n"
      "0 0 0 xy xz yz\n\nAtoms # ellipsoid\n\n2 1 1 3.0 3 0 0 1 0 0\n1 1 1 1.0 0 0 0 0 0 0\n\n"
      "Ellipsoids\n\n1 2 2 1 1 0 0 0\n2 2 1 1 0.7071067811865476 0 0 0.7071067811865476\n\n"
      "Velocities\n\n1 0.1 0 0 0 0 0\n2 -0.1 0 0 0 0 0.5\n";
  const Configuration3 state = read("a.data", data);
  using std::numbers::pi;
  EXPECT_NEAR(state.mass[0], 2 * pi / 3, 1e-14);
  EXPECT_NEAR(state.mass[1], 3 * pi / 3, 1e-14);
  EXPECT_EQ(state.image[1].x(), 1);
  // About the z axis, which is across the long one: I = m (a² + b²)/5.
  EXPECT_NEAR(state.angular_velocity[1].z(), 0.5 / (state.mass[1] * (1 + 0.25) / 5), 1e-12);
  const std::string unnamed = std::string(data).replace(data.find(" # ellipsoid"), 12, "");
  expect_refusal(text("b.data", unnamed), "should name its style");
  const std::string damaged = std::string(data).replace(data.find("Atoms #"), 7, "Atomsx #");
  expect_refusal(text("c.data", damaged), "has no section Atoms");
}

TEST_F(Import, TimesAndLengthsOfTheUser) {
  KnownSystem known;
  known.import.time_per_step = 0.5;
  known.import.length_unit = 2;
  const std::string dump =
      dump_frame(10, "x y z radius vx vy vz", "0 1 3 1 4 0 0\n3 3 9 1 0 0 0\n");
  const TrajectoryReader reader(text("a.dump", dump), known);
  const Configuration3 state = reader.read<3>(0);
  EXPECT_EQ(reader.units()->time, "(unit of time)");
  EXPECT_EQ(state.time, 5);
  EXPECT_EQ(state.box.lengths(), Vec3(5, 5, 5));
  EXPECT_EQ(state.shape[0].semi_axes, Vec3(0.5, 0.5, 0.5));
  EXPECT_EQ(state.velocity[0], Vec3(2, 0, 0));
  EXPECT_THAT(report(file("a.dump"), known).at("converted"),
              HasSubstr("lengths are divided by 2, times are steps times 0.5"));
  expect_refusal(h5md("a.h5", two_disks),
                 "its time is 1, but its step 1 times import.time_per_step is 0.5", known);
  expect_refusal(text("a.csv", small_csv), "needs steps", known);
}

TEST_F(Import, SizesOfTheUser) {
  const std::string atoms = "1 0 1 3\n2 3 3 9\n";
  const std::filesystem::path path = text("a.dump", dump_frame(0, "type x y z", atoms));
  expect_refusal(path, "gives diameter or semi-axes of 1, 2");
  KnownSystem known;
  known.species = {{"1", Vec3(1, 1, 1)}};
  expect_refusal(path, "gives diameter or semi-axes of 2", known);
  known.species.push_back({"2", Vec3(2, 2, 2), 3.0});
  const Configuration3 state = TrajectoryReader(path, known).read<3>(0);
  EXPECT_EQ(state.mass, (std::vector<double>{1, 3}));
  EXPECT_EQ(state.shape[1].semi_axes, Vec3(2, 2, 2));
}

TEST_F(Import, ColumnsWithOtherNames) {
  KnownSystem known;
  known.import.columns = {{"c_q[1]", "qw"}, {"c_q[2]", "qx"}, {"c_q[3]", "qy"}, {"c_q[4]", "qz"}};
  const std::string columns = "x y z c_q[1] c_q[2] c_q[3] c_q[4] shapex shapey shapez";
  const std::string atoms = "0 1 3 0 1 0 0 2 1 1\n3 3 9 1 0 0 0 2 1 1\n";
  const std::filesystem::path path = text("a.dump", dump_frame(0, columns, atoms));
  expect_refusal(path, "has no orientations, but particle 0 is not round");
  EXPECT_EQ(TrajectoryReader(path, known).read<3>(0).orientation[0].x(), 1);
  known.import.columns = {{"X", "x"}, {"Y", "y"}};
  EXPECT_EQ(refusal(text("a.csv", "X,Y,radius,box_x,box_y\n0,0,1,9,9\n"), known), "read");
  expect_refusal(file("a.csv"), "[[import.columns]]");
  known.import.columns = {{"Z", "z"}};
  expect_refusal(file("a.csv"), "import.columns names \"Z\"", known);
}

// A body that rotates moves as its velocity and its angular velocity say; one of them alone does not tell.
TEST_F(Import, VelocitiesWithoutAngularVelocitiesAreLeftOut) {
  const std::string header = "x,y,angle,a,b,vx,vy,box_x,box_y\n";
  const TrajectoryReader ellipse(text("a.csv", header + "0,0,0,1,0.5,1,1,9,9\n"));
  EXPECT_FALSE(ellipse.has("velocity"));
  EXPECT_THAT(report(file("a.csv")).at("absent"), HasSubstr("so velocities are left out"));
  const TrajectoryReader disk(text("b.csv", header + "0,0,0,1,1,1,1,9,9\n"));
  EXPECT_TRUE(disk.has("velocity"));
}

// No frame stands in for another, or for nothing.
TEST_F(Import, AllFramesStateTheSame) {
  const std::string first =
      dump_frame(0, "x y z ix iy iz radius vx vy vz", "0 1 3 1 0 0 1 1 0 0\n3 3 9 0 0 0 1 0 0 0\n");
  expect_refusal(text("a.dump", first + dump_frame(1, "x y z radius vx vy vz",
                                                   "0 1 3 1 1 0 0\n3 3 9 1 0 0 0\n")),
                 "frame 1: states positions, semi-axes, velocities, steps, but frame 0 "
                 "states positions, box crossings, semi-axes, velocities, steps");
  expect_refusal(text("b.dump", first + dump_frame(1, "x y z ix iy iz radius",
                                                   "0 1 3 1 0 0 1\n3 3 9 0 0 0 1\n")),
                 "frame 1: states positions, box crossings, semi-axes, steps");
}

TEST_F(Import, RepeatedFramesLeaveOutMotionOnly) {
  const std::string dump = dump_frame(3, "x y z ix iy iz radius", "0 1 3 0 0 0 1\n3 3 9 0 0 0 1\n");
  const TrajectoryReader reader(text("a.dump", dump + dump));
  EXPECT_EQ(reader.frames(), 2u);
  EXPECT_EQ(reader.units()->time, "steps");
  EXPECT_THAT(reader.obstacle_to_motion(), HasSubstr("frame 1 has the time 3"));
}

TEST_F(Import, AnElementOfH5mdHasANumberForEachFrame) {
  for (const char* name : {"image", "position"})
    expect_refusal(h5md(std::string(name) + ".h5",
                        [&](h5::Group& particles) {
                          if (name != std::string("position")) two_disks(particles);
                          particles.create_group(name).create_array<double>("value", {},
                                                                            std::vector{1.0});
                        }),
                   std::string(name) + " is a single number, but needs one for each frame");
}

}  // namespace
}  // namespace vitrel
