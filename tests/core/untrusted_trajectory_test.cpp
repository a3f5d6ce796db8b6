// Trajectories that are damaged, inconsistent or written by other programs are read correctly, or
// refused by one message.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/io/h5md.h"
#include "core/random/stream.h"
#include "tests/support/files.h"
#include "tests/support/stored_frames.h"

/// HDF5 1.10 loses a few hundred bytes when it meets damaged metadata.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming): the sanitizer's name
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class UntrustedTrajectory : public Files {
 protected:
  static std::string open_error(const fs::path& path) {
    return file_error([&] { TrajectoryReader reader(path); });
  }
  static std::string append_error(const fs::path& path, std::uint64_t frames) {
    return file_error([&] { TrajectoryWriter::append_to(path, frames); });
  }
  template <class Change>
  static void change(const fs::path& path, Change&& change_root) {
    h5::File written = h5::File::open(path, h5::Access::write);
    h5::Group root = written.root();
    change_root(root);
    written.close();
  }

  const fs::path run_ = file("run.h5"), foreign_ = file("foreign.h5");
};

TEST_F(UntrustedTrajectory, TruncatedFilesGiveOneMessageAndNoCrash) {
  write_run(run_, 4);
  const std::string whole = contents(run_);
  const fs::path cut = file("cut.h5");
  for (double part : {0.0, 0.001, 0.01, 0.1, 0.5, 0.9, 0.999}) {
    overwrite(cut, whole.substr(0, static_cast<std::size_t>(part * whole.size())));
    const std::string message = file_error([&] { TrajectoryReader(cut).read(3); });
    EXPECT_THAT(message, HasSubstr(cut.string() + ": "));
    const auto is_empty = HasSubstr("is empty"), is_cut = HasSubstr("the file is truncated");
    EXPECT_THAT(message, testing::AnyOf(is_empty, is_cut));
    if (part == 0) {
      EXPECT_THAT(message, is_empty);
    }
    if (part >= 0.1) {
      EXPECT_THAT(message, is_cut);
    }
    EXPECT_THAT(append_error(cut, 1), HasSubstr(cut.string()));
  }
}

// Zeros over a piece in the middle: an error or the right numbers, never a crash or wrong numbers.
TEST_F(UntrustedTrajectory, DamagedFilesNeverGiveWrongNumbers) {
  write_run(run_, 4);
  const std::string whole = contents(run_);
  const Configuration2 right = random_configuration(12, 3);
  int failures = 0;
  for (std::size_t begin = 0; begin + 512 <= whole.size(); begin += 512) {
    std::string damaged = whole;
    std::fill_n(damaged.begin() + begin, 512, '\0');
    overwrite(file("damaged.h5"), damaged);
    try {
      const TrajectoryReader reader(file("damaged.h5"));
      if (reader.frames() != 4) continue;  // the axis itself; its length is checked by append_to
      const Configuration2 found = reader.read(3);
      EXPECT_TRUE(same_bits(found.position, right.position)) << begin;
      EXPECT_TRUE(same_bits(found.mass, right.mass)) << begin;
      EXPECT_TRUE(same_bits(found.shape, right.shape)) << begin;
      EXPECT_EQ(found.species, right.species) << begin;
    } catch (const FileError& error) {
      EXPECT_THAT(error.what(), HasSubstr("damaged.h5"));
      ++failures;
    }
  }
  EXPECT_GT(failures, 10);
}

// Refused, or the same configuration.
TEST_F(UntrustedTrajectory, AFlippedBitIsHarmlessOrNoticed) {
  write_run(run_, 4);
  const std::string whole = contents(run_);
  const Configuration2 right = TrajectoryReader(run_).read<2>(3);
  Stream draw(3, Purpose::tests);
  int noticed = 0;
  for (int k = 0; k < 1000; ++k) {
    overwrite(file("damaged.h5"), with_a_flipped_bit(whole, draw));
    try {
      const TrajectoryReader reader(file("damaged.h5"));
      EXPECT_EQ(reader.frames(), 4u) << k;
      if (reader.frames() == 4) expect_same_bits(reader.read<2>(3), right);
    } catch (const FileError& error) {
      EXPECT_THAT(error.what(), HasSubstr("damaged.h5"));
      ++noticed;
    }
    if (HasFailure()) FAIL() << k;
  }
  EXPECT_GT(noticed, 10);
}

TEST_F(UntrustedTrajectory, MissingFilesAndOtherFormats) {
  EXPECT_THAT(open_error(file("absent.h5")),
              HasSubstr("absent.h5: cannot open the file: No such file"));
  overwrite(file("text.h5"), "not HDF5 but long enough to look at\n");
  EXPECT_THAT(open_error(file("text.h5")), HasSubstr("is not recognised as H5MD, GSD"));
  overwrite(file("binary.h5"), std::string("not\0HDF5", 8));
  EXPECT_THAT(open_error(file("binary.h5")), HasSubstr("it is binary"));
  h5::File::create(file("empty.h5")).close();
  EXPECT_THAT(open_error(file("empty.h5")), HasSubstr("has no group particles"));
}

// As HDF5 itself locks them; nothing in such a file tells its states apart.
TEST_F(UntrustedTrajectory, AFileThatAnotherProgramWritesIsRefused) {
  write_run(run_, 2);
  const int other = open(run_.c_str(), O_RDWR);
  ASSERT_EQ(flock(other, LOCK_EX | LOCK_NB), 0);
  EXPECT_THAT(open_error(run_),
              HasSubstr("run.h5: cannot open the file: another program has it open"));
  static_cast<void>(close(other));
}

/// Writes the least that H5MD and this program ask for, as another program may write it:
/// two-dimensional, a fixed box given by its lengths with the origin in a corner, single step and
/// time increments. `change` changes the group of particles.
template <class Change>
void write_foreign_file(const fs::path& path, Change&& change) {
  h5::File file = h5::File::create(path);
  h5::Group particles = file.root().create_group("particles").create_group("water");
  h5::Group box = particles.create_group("box");
  box.create_array<double>("edges", {2}, std::array{4.0, 2.0});
  h5::Group position = particles.create_group("position");
  position.create_array<double>("value", {2, 2, 2},
                                std::array{1.0, 0.5, 3.5, 1.5, 1.5, 0.5, 3.75, 1.0});
  position.create_array<std::int64_t>("step", {}, std::array<std::int64_t, 1>{10});
  position.create_array<double>("time", {}, std::array{0.5}).set_attribute("offset", 2.0);
  particles.create_group("angle").create_array<double>("value", {2, 2},
                                                       std::array{0.0, 1.0, 2.0, 3.0});
  particles.create_array<double>("semiaxes", {2, 2}, std::array{2.0, 1.0, 1.0, 1.0});
  change(particles);
  file.close();
}

TEST_F(UntrustedTrajectory, ReadsWhatOtherProgramsWrite) {
  write_foreign_file(foreign_, [](h5::Group&) {});
  const TrajectoryReader reader(foreign_);
  EXPECT_EQ(reader.times(), (std::vector{2.0, 2.5}));
  EXPECT_EQ(reader.steps(), (std::vector<std::int64_t>{0, 10}));
  const Configuration2 frame = reader.read(1);
  EXPECT_EQ(frame.box.lengths(), Vec2(4, 2));
  EXPECT_EQ(frame.position[0], Vec2(1.5, 0.5));
  EXPECT_EQ(frame.position[1], Vec2(-0.25, -1));
  EXPECT_EQ(frame.angle, (std::vector{2.0, 3.0}));
  EXPECT_EQ(frame.shape[0].a, 2);
  EXPECT_EQ(frame.mass[1], 1);
  EXPECT_FALSE(reader.has("image"));
}

TEST_F(UntrustedTrajectory, AMissingDatasetIsNamed) {
  write_foreign_file(foreign_, [](h5::Group& particles) { particles.remove("semiaxes"); });
  EXPECT_THAT(open_error(foreign_),
              HasSubstr("foreign.h5: frame 0: has no sizes: it has no dataset semiaxes"));
}

TEST_F(UntrustedTrajectory, StepsAndBoxCrossingsMustBeWholeNumbersOfAFewDigits) {
  const auto message_about = [&](double step, double image) {
    write_foreign_file(foreign_, [&](h5::Group& particles) {
      particles.create_group("image").create_array<double>(
          "value", {2, 2, 2}, std::array{0., 0., 0., image, 0., 0., 0., 0.});
      particles.dataset("position/step").set_attribute("offset", step);
    });
    return file_error([&] { TrajectoryReader(foreign_).read(0); });
  };
  EXPECT_EQ(message_about(3, -1), "(no FileError)");
  for (const double wrong : {double{NAN}, double{INFINITY}, 1e300}) {
    EXPECT_THAT(message_about(wrong, 0), HasSubstr("but should be a whole number"));
    EXPECT_THAT(message_about(0, wrong),
                HasSubstr(std::isfinite(wrong) ? "frame 0: image has impossible numbers"
                                               : "not finite in frame 0"));
  }
}

TEST_F(UntrustedTrajectory, MassesAndSpeciesMustMakeSense) {
  const auto message_about = [&](const std::array<double, 2>& masses,
                                 const std::array<std::int32_t, 2>& species) {
    write_foreign_file(foreign_, [&](h5::Group& particles) {
      particles.create_array<double>("mass", {2}, masses);
      particles.create_array<std::int32_t>("species", {2}, species);
    });
    return open_error(foreign_);
  };
  EXPECT_EQ(message_about({1, 2}, {0, 1}), "(no FileError)");
  for (const double mass : {0., -1., double{NAN}, double{INFINITY}})
    EXPECT_THAT(message_about({1, mass}, {0, 0}),
                testing::AnyOf(HasSubstr("frame 0: the mass of particle 1 is "),
                               HasSubstr("water/mass has numbers that are not finite")));
  EXPECT_EQ(message_about({1, 1}, {2'147'483'647, -1}), "(no FileError)");
  EXPECT_EQ(TrajectoryReader(foreign_).species_names(),
            (std::vector<std::string>{"-1", "2147483647"}));
}

// Made longer, they would be zero in the frames that are missing.
TEST_F(UntrustedTrajectory, SeriesThatLackFramesAreNotContinued) {
  write_run(file("whole.h5"), 4);
  const fs::path lacking = file("short.h5");
  for (const std::string name :
       {"particles/all/position/value", "particles/all/position/time", "particles/all/angle/value",
        "particles/all/image/value", "particles/all/box/edges/value", "observables/energy/value"}) {
    fs::copy_file(file("whole.h5"), lacking, fs::copy_options::overwrite_existing);
    change(lacking, [&](h5::Group& root) { root.dataset(name).resize(2); });
    EXPECT_THAT(append_error(lacking, 3),
                HasSubstr("short.h5: the dataset " + name + " has fewer frames than step"));
    EXPECT_EQ(append_error(lacking, 2), "(no FileError)");
  }
}

TEST_F(UntrustedTrajectory, ASeriesOfAnotherShapeIsNotContinued) {
  const auto message_about = [&](const std::string& parent, const h5::Shape& shape) {
    fs::remove(run_);
    write_run(run_, 1);
    change(run_, [&](h5::Group& root) {
      h5::Group group = root.group(parent);
      group.remove("value");
      group.create_array<double>("value", shape, std::vector<double>(shape.empty() ? 1 : 12));
    });
    return append_error(run_, 1);
  };
  EXPECT_THAT(message_about("observables/energy", {}),
              HasSubstr("run.h5: the dataset observables/energy/value should have one entry per"));
  EXPECT_THAT(message_about("particles/all/position", {12}),
              HasSubstr("position/value should have the shape frames × particles × 3"));
}

TEST_F(UntrustedTrajectory, AnAttributeThatIsNoSingleStringIsRefused) {
  write_run(run_, 1);
  change(run_, [](h5::Group& root) {
    root.group("parameters").set_attribute("author", std::vector<std::string>(100, "a"), 1);
  });
  EXPECT_THAT(open_error(run_), testing::AllOf(HasSubstr("run.h5: "), HasSubstr("author"),
                                               HasSubstr("it is not one string")));
}

/// A box given by cell vectors, no provenance, orientations in single precision.
void write_foreign_solid(const fs::path& path, double norm) {
  h5::File file = h5::File::create(path);
  h5::Group particles = file.root().create_group("particles").create_group("grains");
  particles.create_group("box").create_array<double>(
      "edges", {3, 3}, std::array{4.0, 0.0, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 6.0});
  h5::Group position = particles.create_group("position");
  position.create_array<double>("value", {1, 1, 3}, std::array{1.0, 2.0, 3.5});
  position.create_array<std::int64_t>("step", {1}, std::array<std::int64_t, 1>{0});
  position.create_array<double>("time", {1}, std::array{0.0});
  const double w = static_cast<float>(norm * std::sqrt(0.5));
  particles.create_group("orientation")
      .create_array<double>("value", {1, 1, 4}, std::array{w, 0.0, 0.0, w});
  particles.create_array<double>("semiaxes", {1, 3}, std::array{3.0, 1.0, 2.0});
  file.close();
}

TEST_F(UntrustedTrajectory, ReadsSolidsThatOtherProgramsWrite) {
  write_foreign_solid(foreign_, 1);
  const Configuration3 frame = read_state<3>(foreign_);
  EXPECT_EQ(frame.box.lengths(), Vec3(4, 5, 6));
  EXPECT_EQ(frame.position[0], Vec3(1, 2, -2.5));
  EXPECT_EQ(frame.shape[0].semi_axes, Vec3(3, 1, 2));
  EXPECT_NEAR(frame.orientation[0].norm(), 1, 4e-16);
  write_foreign_solid(foreign_, 1.001);
  EXPECT_THAT(file_error([&] { read_state<3>(foreign_); }),
              HasSubstr("the orientation of particle 0 has the norm 1.00099"));
}

// The first of the frames at fault is named, counted from 0.
TEST_F(UntrustedTrajectory, TimesMustBeFiniteAndForMotionAscend) {
  const fs::path path = file("times.h5");
  const auto message_about = [&](const std::vector<double>& times) {
    Configuration2 frame = random_configuration(3, 0);
    TrajectoryWriter writer = TrajectoryWriter::create(path, frame, {}, {.overwrite = true});
    for (const double time : times) {
      frame.time = time;
      writer.write(frame, 0);
    }
    writer.close();
    std::string obstacle;
    const std::string error =
        file_error([&] { obstacle = TrajectoryReader(path).obstacle_to_motion(); });
    return obstacle.empty() ? error : obstacle;
  };
  EXPECT_EQ(message_about({-1, 0, 2}), "(no FileError)");
  EXPECT_THAT(message_about({0, 1, NAN, 3}),
              HasSubstr("times.h5: the time of frame 2 (dataset particles/all/position/time) is "
                        "nan, but should be a finite number"));
  EXPECT_THAT(message_about({0, INFINITY}), HasSubstr("frame 1"));
  EXPECT_THAT(
      message_about({0, 1, 0.5}),
      HasSubstr("frame 2 has the time 0.5, which is not above that of the frame before, 1"));
  EXPECT_THAT(message_about({0.1, 0.1}), HasSubstr("frame 1"));
}

}  // namespace
}  // namespace vitrel
