// Trajectories come back from their files bit-identical, also those that were continued or ran out
// of disk.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/io/h5md.h"
#include "tests/support/files.h"
#include "tests/support/small_disk.h"
#include "tests/support/stored_frames.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class TrajectoryFile : public Files {
 protected:
  const fs::path run_ = file("run.h5"), state_ = file("state.h5");
};

TEST_F(TrajectoryFile, FramesComeBackBitByBit) {
  write_run(run_, 5);
  const TrajectoryReader reader(run_);
  EXPECT_EQ(reader.frames(), 5u);
  EXPECT_EQ(reader.particles(), 12u);
  EXPECT_EQ(reader.times()[3], 0.1 * 3);
  EXPECT_EQ(reader.observable_names(), (std::vector<std::string>{"collisions", "energy"}));
  EXPECT_TRUE(reader.has_observable("energy"));
  EXPECT_FALSE(reader.has_observable("virial"));
  expect_frames(run_, 5);
}

TEST_F(TrajectoryFile, FramesOfThreeDimensionsComeBackBitByBit) {
  auto writer =
      TrajectoryWriter::create(run_, random_solids(9, 0), some_provenance(), {.velocities = true});
  for (int k = 0; k < 3; ++k) writer.write(random_solids(9, k), k);
  writer.close();
  TrajectoryWriter::append_to(run_, 2).write(random_solids(9, 5), 5);
  const TrajectoryReader reader(run_);
  EXPECT_EQ(reader.dimension(), 3);
  EXPECT_EQ(reader.provenance().dimension, 3);
  EXPECT_EQ(reader.particles(), 9u);
  EXPECT_EQ(reader.frames(), 3u);
  for (const int k : {0, 1}) expect_same_bits(reader.read<3>(k), random_solids(9, k));
  expect_same_bits(read_state<3>(run_), random_solids(9, 5));
  EXPECT_FALSE(reader.has("angle"));
}

TEST_F(TrajectoryFile, TheOtherDimensionIsRefused) {
  write_state(file("solids.h5"), random_solids(4, 0), some_provenance());
  write_state(file("flat.h5"), random_configuration(4, 0), some_provenance());
  EXPECT_THAT(file_error([&] { read_state(file("solids.h5")); }),
              HasSubstr("solids.h5: is three-dimensional, but"));
  EXPECT_THAT(file_error([&] { read_state<3>(file("flat.h5")); }),
              HasSubstr("flat.h5: is two-dimensional, but"));
  auto writer = TrajectoryWriter::append_to(file("flat.h5"), 1);
  EXPECT_THROW(writer.write(random_solids(4, 0), 1), UserError);
}

TEST_F(TrajectoryFile, ProvenanceComesBack) {
  const Provenance written = some_provenance();
  TrajectoryWriter::create(run_, random_configuration(4, 0), written).record_wall_seconds(3.5);
  const Provenance read = TrajectoryReader(run_).provenance();
  EXPECT_EQ(read.version, program_version());
  EXPECT_EQ(read.commit, program_commit());
  EXPECT_EQ(read.command_line, "vitrel run glass.toml");
  EXPECT_EQ(read.parameters, "[system]\nparticles = 12 # κ\n");
  EXPECT_EQ(read.seed, 77u);
  EXPECT_EQ(read.parent, "state.h5");
  EXPECT_EQ(read.host, written.host);
  EXPECT_EQ(read.started, written.started);
  EXPECT_EQ(read.wall_seconds, 3.5);
  EXPECT_FALSE(read.version.empty());
}

TEST_F(TrajectoryFile, ParametersLongerThanAnAttributeCanHold) {
  Provenance provenance = some_provenance();
  provenance.parameters = std::string(200'000, '#');
  TrajectoryWriter::create(run_, random_configuration(4, 0), provenance);
  EXPECT_EQ(TrajectoryReader(run_).provenance().parameters, provenance.parameters);
}

TEST_F(TrajectoryFile, PositionsOutsideTheBoxAreWrapped) {
  Configuration2 outside = random_configuration(4, 0);
  const Vec2 far = outside.unwrapped(2) + Vec2(100, -50);
  outside.position[2] = far;
  outside.image[2] = {0, 0};
  write_state(state_, outside, some_provenance());
  const Configuration2 read = read_state(state_);
  EXPECT_LE((read.position[2].cwiseQuotient(read.box.lengths())).cwiseAbs().maxCoeff(), 0.5);
  EXPECT_LT((read.unwrapped(2) - far).norm(), 1e-12);
}

TEST_F(TrajectoryFile, StateIsTheLastFrame) {
  write_run(run_, 3);
  expect_same_bits(read_state(run_), random_configuration(12, 2));
  write_state(state_, random_configuration(7, 4), some_provenance());
  expect_same_bits(read_state(state_), random_configuration(7, 4));
  TrajectoryWriter::create(file("empty.h5"), random_configuration(7, 4), some_provenance());
  EXPECT_THAT(file_error([&] { read_state(file("empty.h5")); }), HasSubstr("no frames"));
}

TEST_F(TrajectoryFile, WithoutVelocitiesTheyAreZeroAndMissed) {
  TrajectoryWriter::create(run_, random_configuration(6, 0), some_provenance())
      .write(random_configuration(6, 0), 0);
  const TrajectoryReader reader(run_);
  EXPECT_FALSE(reader.has("velocity"));
  EXPECT_TRUE(reader.has("image"));
  EXPECT_EQ(reader.read(0).velocity[3], Vec2(0, 0));
}

// The file has what a particle in contact will do after it.
TEST_F(TrajectoryFile, VelocitiesAreThoseAfterContact) {
  Configuration2 c = random_configuration(12, 0);
  c.releases = {{3, 4, 1.5, {7, 8}}};
  write_state(state_, c, some_provenance());
  const Configuration2 read = read_state(state_);
  EXPECT_EQ(read.velocity[3], Vec2(7, 8));
  EXPECT_EQ(read.velocity[4], c.velocity[4]);
  EXPECT_EQ(mechanics(read).momentum, mechanics(c).momentum);
}

template <int Dim>
void expect_same_close_pairs(const Configuration<Dim>& x, const Configuration<Dim>& y) {
  ASSERT_EQ(x.close_pairs.size(), y.close_pairs.size());
  for (std::size_t k = 0; k < x.close_pairs.size(); ++k) {
    EXPECT_EQ(x.close_pairs[k].pair.i, y.close_pairs[k].pair.i);
    EXPECT_EQ(x.close_pairs[k].pair.j, y.close_pairs[k].pair.j);
    EXPECT_EQ(x.close_pairs[k].pair.shift, y.close_pairs[k].pair.shift);
    EXPECT_EQ(x.close_pairs[k].distance, y.close_pairs[k].distance);
  }
}

TEST_F(TrajectoryFile, KeepsTheClosePairsOfEveryFrame) {
  const auto flat = [](std::uint64_t k) {
    return with_close_pairs(random_configuration(12, k), k);
  };
  const TrajectoryOptions soft{.velocities = true, .close_pairs = true};
  auto writer = TrajectoryWriter::create(run_, flat(0), some_provenance(), soft);
  for (std::uint64_t k = 0; k < 4; ++k) writer.write(flat(k), static_cast<std::int64_t>(k));
  writer.close();
  // Continued after two frames, with others than before.
  auto again = TrajectoryWriter::append_to(run_, 2);
  again.write(with_close_pairs(random_configuration(12, 2), 0), 2);
  again.write(flat(3), 3);
  again.close();
  const TrajectoryReader reader(run_);
  for (const std::uint64_t k : {0, 1, 3}) {
    expect_same_bits(reader.read(k), flat(k));
    expect_same_close_pairs(reader.read(k), flat(k));
  }
  EXPECT_TRUE(reader.read(2).close_pairs.empty());
  const Configuration3 solids = with_close_pairs(random_solids(12, 0), 5);
  write_state(state_, solids, some_provenance());
  expect_same_close_pairs(read_state<3>(state_), solids);
}

TEST_F(TrajectoryFile, AnExistingFileIsNotOverwrittenUnlessTold) {
  write_run(run_, 3);
  EXPECT_THROW(write_run(run_, 1), UserError);
  EXPECT_THROW(write_state(run_, random_configuration(4, 0), some_provenance()), UserError);
  expect_frames(run_, 3);
  write_state(run_, random_configuration(4, 0), some_provenance(), true);
  EXPECT_EQ(TrajectoryReader(run_).frames(), 1u);
}

// A regular file in place of a folder stops even root.
TEST_F(TrajectoryFile, UnwritableFolderIsNamed) {
  overwrite(file("plain"), "x");
  const fs::path path = file("plain") / "run.h5";
  EXPECT_THAT(file_error([&] { write_run(path, 1); }), HasSubstr(path.string()));
  EXPECT_THAT(file_error([&] { write_run(file("absent") / "run.h5", 1); }),
              HasSubstr("No such file or directory"));
}

TEST_F(TrajectoryFile, FramesMustFitTheFile) {
  auto writer = begin_run(run_, 6);
  EXPECT_THROW(writer.write(random_configuration(7, 0), 0, observables_at(0)), UserError);
  EXPECT_THROW(writer.write(random_configuration(6, 0), 0, {{"energy", 1}}), UserError);
  EXPECT_THROW(writer.write(random_configuration(6, 0), 0), UserError);
  write_frames(writer, 0, 1, 6);
  EXPECT_EQ(writer.frames(), 1u);
}

// 300 frames: several chunks of the time axis, and index nodes that split.
TEST_F(TrajectoryFile, ContinuingEqualsNeverHavingStopped) {
  write_run(run_, 300);
  for (const std::uint64_t keep : {0, 1, 127, 128, 129, 300}) {
    continue_run(run_, keep, 300);
    EXPECT_EQ(TrajectoryReader(run_).frames(), 300u);
    expect_frames(run_, 300);
  }
}

TEST_F(TrajectoryFile, CuttingBackDropsFrames) {
  write_run(run_, 200);
  TrajectoryWriter::append_to(run_, 140);
  EXPECT_EQ(TrajectoryReader(run_).frames(), 140u);
  expect_frames(run_, 140);
  EXPECT_THAT(file_error([&] { TrajectoryWriter::append_to(run_, 141); }),
              HasSubstr("only 140 frames where 141"));
}

// Frames before and after the first particle that has crossed the box more often than 16 bits can count, also of a file
// that is continued.
TEST_F(TrajectoryFile, ImagesGrowBeyond16Bits) {
  const auto frame = [](std::uint64_t k) {
    Configuration2 configuration = random_configuration(12, k);
    if (k >= 200) configuration.image[3] = {32'768, -40'000};
    return configuration;
  };
  const auto write_up_to = [&](TrajectoryWriter& writer, std::uint64_t end) {
    for (std::uint64_t k = writer.frames(); k < end; ++k)
      writer.write(frame(k), static_cast<std::int64_t>(k));
  };
  auto writer = TrajectoryWriter::create(run_, frame(0), some_provenance(), {.velocities = true});
  const auto bytes = [&] {
    writer.commit();
    const h5::File now = h5::File::open(run_, h5::Access::read);
    return now.root().dataset("particles/all/image/value").bytes_per_number();
  };
  write_up_to(writer, 200);
  EXPECT_EQ(bytes(), 2u);
  write_up_to(writer, 201);
  EXPECT_EQ(bytes(), 4u);
  writer.close();
  auto again = TrajectoryWriter::append_to(run_, 150);
  write_up_to(again, 300);
  again.close();
  const TrajectoryReader reader(run_);
  ASSERT_EQ(reader.frames(), 300u);
  for (std::uint64_t k = 0; k < 300; ++k) expect_same_bits(reader.read(k), frame(k));
}

TEST_F(TrajectoryFile, SinglePrecisionRoundsTheNumbersOfParticlesOnce) {
  const Configuration3 solids = random_solids(9, 4);
  TrajectoryWriter writer = TrajectoryWriter::create(
      run_, solids, some_provenance(), {.velocities = true, .single_precision = true});
  writer.write(solids, 0);
  writer.close();
  const TrajectoryReader reader(run_);
  EXPECT_TRUE(reader.has_single_precision());
  const Configuration3 found = reader.read<3>(0);
  EXPECT_EQ(found.box.lengths(), solids.box.lengths());
  EXPECT_EQ(found.time, solids.time);
  EXPECT_TRUE(same_bits(found.shape, solids.shape));
  // The first particle is at the edge, and rounded to the other side.
  EXPECT_LT((found.unwrapped(0) - solids.unwrapped(0)).cwiseAbs().maxCoeff(), 7 * 0x1p-24);
  for (std::size_t i = 1; i < 9; ++i) {
    EXPECT_EQ(found.position[i], solids.position[i].cast<float>().cast<double>());
    EXPECT_EQ(found.velocity[i], solids.velocity[i].cast<float>().cast<double>());
    EXPECT_TRUE(found.orientation[i].isApprox(solids.orientation[i], 0x1p-23));
  }
  write_run(file("double.h5"), 1);
  EXPECT_FALSE(TrajectoryReader(file("double.h5")).has_single_precision());
}

// Three coordinates, an angle, three images, three velocities and an angular velocity.
TEST_F(TrajectoryFile, FramesTakeNoMoreRoomThanTheirNumbers) {
  constexpr std::size_t particles = 1000;
  constexpr std::uint64_t frames = 32;
  const auto bytes_per_particle = [&](TrajectoryOptions options) {
    options.overwrite = true;
    auto writer = TrajectoryWriter::create(run_, random_configuration(particles, 0),
                                           some_provenance(), options);
    const auto before = fs::file_size(run_);
    for (std::uint64_t k = 0; k < frames; ++k)
      writer.write(random_configuration(particles, k), static_cast<std::int64_t>(k));
    writer.close();
    return static_cast<double>(fs::file_size(run_) - before) / frames / particles;
  };
  constexpr double room = 1.5;  // for step, time, box and the index of the chunks
  EXPECT_LT(bytes_per_particle({.velocities = true}), 70 + room);
  EXPECT_LT(bytes_per_particle({.velocities = true, .single_precision = true}), 38 + room);
  EXPECT_LT(bytes_per_particle({.single_precision = true}), 22 + room);
}

// A copy of the file in the middle of a run is what a killed process leaves behind.
TEST_F(TrajectoryFile, ACopyTakenDuringTheRunIsCompleteAndCanBeContinued) {
  auto writer = begin_run(run_);
  const fs::path copy = file("copy.h5");
  for (std::uint64_t k = 0; k <= 70; ++k) {
    if (k % 10 == 0) {
      writer.commit();
      fs::copy_file(run_, copy, fs::copy_options::overwrite_existing);
      EXPECT_EQ(TrajectoryReader(copy).frames(), k);
      continue_run(copy, k, k + 3);
      expect_frames(copy, k + 3);
    }
    write_frames(writer, k, k + 1);
  }
}

TEST_F(TrajectoryFile, AFileBeingWrittenCanBeReadButHasOneWriter) {
  auto writer = begin_run(run_);
  write_frames(writer, 0, 3);
  writer.commit();
  const TrajectoryReader reader(run_);
  EXPECT_EQ(reader.import_report(),
            (ImportReport{{in_progress, fmt::format("another process is writing it; read up to the "
                                                    "time {:.10g} (3 frames)",
                                                    reader.times().back())}}));
  for (std::uint64_t k = 3; k < 200; ++k) {
    write_frames(writer, k, k + 1);
    writer.commit();
    EXPECT_EQ(reader.frames(), 3u);
    expect_same_bits(reader.read<2>(k % 3), random_configuration(12, k % 3));
    EXPECT_EQ(reader.observable("energy").size(), 3u);
  }
  EXPECT_THAT(file_error([&] { TrajectoryWriter::append_to(run_, 0); }),
              HasSubstr("run.h5: cannot open the file: another program has it open"));
  writer.close();
  EXPECT_TRUE(TrajectoryReader(run_).import_report().empty());
  expect_frames(run_, 200);
}

class TrajectoryOnASmallDisk : public SmallDisk {};

TEST_F(TrajectoryOnASmallDisk, WhenFullTheFramesBeforeAreKeptAndTheRunGoesOnLater) {
  const fs::path path = disk_ / "run.h5";
  fill(3'000'000);
  std::uint64_t frames = 0;
  {
    auto writer = begin_run(path, 500);
    const std::string message = file_error([&] {
      for (; frames < 1000; ++frames) {
        write_frames(writer, frames, frames + 1, 500);
        writer.commit();
      }
    });
    EXPECT_THAT(message, HasSubstr(path.string() + ": cannot write: No space left on device"));
  }
  EXPECT_GT(frames, 5u);
  EXPECT_EQ(TrajectoryReader(path).frames(), frames);
  expect_frames(path, frames, 500);
  empty();
  continue_run(path, frames, frames + 2, 500);
  expect_frames(path, frames + 2, 500);
}

TEST_F(TrajectoryOnASmallDisk, CreatingWithoutSpaceLeavesNothing) {
  const fs::path path = disk_ / "state.h5";
  const auto write = [&] { write_state(path, random_configuration(1500, 0), some_provenance()); };
  for (const std::uint64_t free : {0, 4096, 16384, 65536, 131072}) {
    expect_no_space(free, write);
    EXPECT_FALSE(fs::exists(path));
    empty();
  }
  write();
  expect_same_bits(read_state(path), random_configuration(1500, 0));
}

}  // namespace
}  // namespace vitrel
