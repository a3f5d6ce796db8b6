#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/io/checkpoint.h"
#include "core/io/h5md.h"
#include "core/random/stream.h"
#include "tests/support/files.h"
#include "tests/support/partial_files.h"

/// HDF5 1.10 loses a few hundred bytes when it meets damaged metadata.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming): the sanitizer's name
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

class TrajectoryFile : public Files {};
class CheckpointFile : public Files {};

/// Two species, wrapped positions, arbitrary doubles in everything that is stored.
Configuration2 random_configuration(std::size_t n, std::uint64_t step) {
  Stream draw(11, Purpose::tests, step);
  Configuration2 configuration;
  const double scale = std::sqrt(static_cast<double>(n));
  configuration.box = PeriodicBox<2>(scale * Vec2{draw.uniform(3, 9), draw.uniform(3, 9)});
  configuration.time = 0.1 * static_cast<double>(step);
  configuration.resize(n);
  configuration.species_names = {"large", "small"};
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& lengths = configuration.box.lengths();
    configuration.position[i] =
        lengths.cwiseProduct(Vec2{draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5)});
    configuration.image[i] = {static_cast<int>(draw.below(9)) - 4,
                              static_cast<int>(draw.below(9)) - 4};
    configuration.angle[i] = draw.uniform(-40, 40);
    configuration.velocity[i] = {draw.normal(), draw.normal()};
    configuration.angular_velocity[i] = draw.normal();
    const double size = i % 2 ? 1 / 1.4 : 1;
    configuration.shape[i] = {size * std::sqrt(3.0), size / std::sqrt(3.0)};
    configuration.mass[i] = size * size;
    configuration.species[i] = i % 2;
  }
  // The doubles next to the faces, where wrapping would round.
  configuration.position[0] = -0.5 * configuration.box.lengths();
  configuration.position[1].x() = std::nextafter(0.5 * configuration.box.lengths().x(), 0.0);
  return configuration;
}

/// The same in three dimensions, scalene and turned.
Configuration3 random_solids(std::size_t n, std::uint64_t step) {
  Stream draw(12, Purpose::tests, step);
  const auto normal = [&] { return Vec3{draw.normal(), draw.normal(), draw.normal()}; };
  Configuration3 configuration;
  configuration.box = PeriodicBox<3>(Vec3(5, 6, 7) + 0.1 * normal());
  configuration.time = 0.1 * static_cast<double>(step);
  configuration.resize(n);
  configuration.species_names = {"large", "small"};
  for (std::size_t i = 0; i < n; ++i) {
    configuration.position[i] = normal();
    configuration.box.wrap(configuration.position[i], configuration.image[i]);
    configuration.image[i] += Shift<3>(2, -1, static_cast<int>(draw.below(9)));
    configuration.orientation[i].coeffs() << normal(), draw.normal();
    configuration.orientation[i].normalize();
    configuration.velocity[i] = normal();
    configuration.angular_velocity[i] = normal();
    configuration.shape[i] = {i % 2 ? Vec3(0.3, 1.7, 0.9) : Vec3(2, 1, 0.5)};
    configuration.mass[i] = i % 2 ? 0.459 : 1;
    configuration.species[i] = i % 2;
  }
  configuration.position[0] = -0.5 * configuration.box.lengths();
  return configuration;
}

template <class T>
bool same_bits(const std::vector<T>& x, const std::vector<T>& y) {
  if (x.size() != y.size()) return false;
  return x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(T)) == 0;
}

void expect_same_orientations(const Configuration2& x, const Configuration2& y) {
  EXPECT_TRUE(same_bits(x.angle, y.angle));
}
void expect_same_orientations(const Configuration3& x, const Configuration3& y) {
  EXPECT_TRUE(same_bits(x.orientation, y.orientation));
}

template <int Dim>
void expect_same_bits(const Configuration<Dim>& x, const Configuration<Dim>& y) {
  EXPECT_EQ(x.box.lengths(), y.box.lengths());
  EXPECT_EQ(std::bit_cast<std::uint64_t>(x.time), std::bit_cast<std::uint64_t>(y.time));
  EXPECT_TRUE(same_bits(x.position, y.position));
  EXPECT_TRUE(same_bits(x.image, y.image));
  expect_same_orientations(x, y);
  EXPECT_TRUE(same_bits(x.velocity, y.velocity));
  EXPECT_TRUE(same_bits(x.angular_velocity, y.angular_velocity));
  EXPECT_TRUE(same_bits(x.shape, y.shape));
  EXPECT_TRUE(same_bits(x.mass, y.mass));
  EXPECT_EQ(x.species, y.species);
  EXPECT_EQ(x.species_names, y.species_names);
}

Provenance some_provenance() {
  return current_provenance("vitrel run glass.toml", "[system]\nparticles = 12 # κ\n", 77,
                            "state.h5");
}

const TrajectoryOptions with_everything{
    .velocities = true, .observables = {"collisions", "energy"}, .overwrite = false};

Observables observables_at(std::uint64_t step) {
  return {{"collisions", 10.0 * static_cast<double>(step)}, {"energy", std::sqrt(step + 2.0)}};
}

void write_frames(TrajectoryWriter& writer, std::uint64_t first, std::uint64_t end,
                  std::size_t particles = 12) {
  for (std::uint64_t step = first; step < end; ++step)
    writer.write(random_configuration(particles, step), static_cast<std::int64_t>(step),
                 observables_at(step));
}

/// Frames 0 … frames − 1 of `path` are those that write_frames writes; the file may hold more.
void expect_frames(const fs::path& path, std::uint64_t frames, std::size_t particles = 12) {
  const TrajectoryReader reader(path);
  ASSERT_GE(reader.frames(), frames);
  for (std::uint64_t k = 0; k < frames; ++k) {
    EXPECT_EQ(reader.steps()[k], static_cast<std::int64_t>(k));
    expect_same_bits(reader.read(k), random_configuration(particles, k));
    EXPECT_EQ(reader.observable("collisions")[k], observables_at(k).at("collisions"));
    EXPECT_EQ(reader.observable("energy")[k], observables_at(k).at("energy"));
  }
}

/// With one close pair more in every frame, from none, between images.
template <int Dim>
Configuration<Dim> with_close_pairs(Configuration<Dim> configuration, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const Shift<Dim> shift = Shift<Dim>::Unit(static_cast<int>(k) % Dim) * (k % 2 ? 1 : -1);
    configuration.close_pairs.push_back({{k, k + 1, shift}, 0.1 + static_cast<double>(k)});
  }
  return configuration;
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

void write_run(const fs::path& path, std::uint64_t frames, std::size_t particles = 12) {
  auto writer = TrajectoryWriter::create(path, random_configuration(particles, 0),
                                         some_provenance(), with_everything);
  write_frames(writer, 0, frames, particles);
  writer.close();
}

/// The message of the FileError that `action` throws.
template <class Action>
std::string file_error(Action&& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return "(no FileError)";
}

TEST_F(TrajectoryFile, FramesComeBackBitByBit) {
  write_run(file("run.h5"), 5);
  const TrajectoryReader reader(file("run.h5"));
  EXPECT_EQ(reader.frames(), 5u);
  EXPECT_EQ(reader.particles(), 12u);
  EXPECT_EQ(reader.times()[3], 0.1 * 3);
  EXPECT_EQ(reader.observable_names(), (std::vector<std::string>{"collisions", "energy"}));
  EXPECT_TRUE(reader.has_observable("energy"));
  EXPECT_FALSE(reader.has_observable("virial"));
  expect_frames(file("run.h5"), 5);
}

TEST_F(TrajectoryFile, FramesOfThreeDimensionsComeBackBitByBit) {
  auto writer = TrajectoryWriter::create(file("run.h5"), random_solids(9, 0), some_provenance(),
                                         {.velocities = true});
  for (int k = 0; k < 3; ++k) writer.write(random_solids(9, k), k);
  writer.close();
  TrajectoryWriter::append_to(file("run.h5"), 2).write(random_solids(9, 5), 5);
  const TrajectoryReader reader(file("run.h5"));
  EXPECT_EQ(reader.dimension(), 3);
  EXPECT_EQ(reader.provenance().dimension, 3);
  EXPECT_EQ(reader.particles(), 9u);
  EXPECT_EQ(reader.frames(), 3u);
  for (const int k : {0, 1}) expect_same_bits(reader.read<3>(k), random_solids(9, k));
  expect_same_bits(read_state<3>(file("run.h5")), random_solids(9, 5));
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
  Provenance written = some_provenance();
  TrajectoryWriter::create(file("run.h5"), random_configuration(4, 0), written)
      .record_wall_seconds(3.5);
  const Provenance read = TrajectoryReader(file("run.h5")).provenance();
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
  TrajectoryWriter::create(file("run.h5"), random_configuration(4, 0), provenance);
  EXPECT_EQ(TrajectoryReader(file("run.h5")).provenance().parameters, provenance.parameters);
}

TEST_F(TrajectoryFile, PositionsOutsideTheBoxAreWrapped) {
  Configuration2 outside = random_configuration(4, 0);
  const Vec2 far = outside.unwrapped(2) + Vec2(100, -50);
  outside.position[2] = far;
  outside.image[2] = {0, 0};
  write_state(file("state.h5"), outside, some_provenance());
  const Configuration2 read = read_state(file("state.h5"));
  EXPECT_LE((read.position[2].cwiseQuotient(read.box.lengths())).cwiseAbs().maxCoeff(), 0.5);
  EXPECT_LT((read.unwrapped(2) - far).norm(), 1e-12);
}

TEST_F(TrajectoryFile, StateIsTheLastFrame) {
  write_run(file("run.h5"), 3);
  expect_same_bits(read_state(file("run.h5")), random_configuration(12, 2));
  write_state(file("state.h5"), random_configuration(7, 4), some_provenance());
  expect_same_bits(read_state(file("state.h5")), random_configuration(7, 4));
  TrajectoryWriter::create(file("empty.h5"), random_configuration(7, 4), some_provenance());
  EXPECT_THAT(file_error([&] { read_state(file("empty.h5")); }), HasSubstr("no frames"));
}

TEST_F(TrajectoryFile, WithoutVelocitiesTheyAreZeroAndMissed) {
  {
    auto writer =
        TrajectoryWriter::create(file("run.h5"), random_configuration(6, 0), some_provenance());
    writer.write(random_configuration(6, 0), 0);
  }
  const TrajectoryReader reader(file("run.h5"));
  EXPECT_FALSE(reader.has("velocity"));
  EXPECT_TRUE(reader.has("image"));
  EXPECT_EQ(reader.read(0).velocity[3], Vec2(0, 0));
}

TEST_F(TrajectoryFile, AnExistingFileIsNotOverwrittenUnlessTold) {
  write_run(file("run.h5"), 3);
  EXPECT_THROW(write_run(file("run.h5"), 1), UserError);
  EXPECT_THROW(write_state(file("run.h5"), random_configuration(4, 0), some_provenance()),
               UserError);
  expect_frames(file("run.h5"), 3);
  write_state(file("run.h5"), random_configuration(4, 0), some_provenance(), true);
  EXPECT_EQ(TrajectoryReader(file("run.h5")).frames(), 1u);
}

TEST_F(TrajectoryFile, FramesMustFitTheFile) {
  auto writer = TrajectoryWriter::create(file("run.h5"), random_configuration(6, 0),
                                         some_provenance(), with_everything);
  EXPECT_THROW(writer.write(random_configuration(7, 0), 0, observables_at(0)), UserError);
  EXPECT_THROW(writer.write(random_configuration(6, 0), 0, {{"energy", 1}}), UserError);
  EXPECT_THROW(writer.write(random_configuration(6, 0), 0), UserError);
  writer.write(random_configuration(6, 0), 0, observables_at(0));
  EXPECT_EQ(writer.frames(), 1u);
}

std::string contents(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// 300 frames: several chunks of the time axis, and index nodes that split.
TEST_F(TrajectoryFile, ContinuingEqualsNeverHavingStopped) {
  write_run(file("run.h5"), 300);
  for (const std::uint64_t keep : {0, 1, 127, 128, 129, 300}) {
    {
      auto writer = TrajectoryWriter::append_to(file("run.h5"), keep);
      EXPECT_EQ(writer.frames(), keep);
      write_frames(writer, keep, 300);
    }
    EXPECT_EQ(TrajectoryReader(file("run.h5")).frames(), 300u);
    expect_frames(file("run.h5"), 300);
  }
}

TEST_F(TrajectoryFile, CuttingBackDropsFrames) {
  write_run(file("run.h5"), 200);
  TrajectoryWriter::append_to(file("run.h5"), 140);
  EXPECT_EQ(TrajectoryReader(file("run.h5")).frames(), 140u);
  expect_frames(file("run.h5"), 140);
  EXPECT_THAT(file_error([&] { TrajectoryWriter::append_to(file("run.h5"), 141); }),
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
  auto writer =
      TrajectoryWriter::create(file("run.h5"), frame(0), some_provenance(), {.velocities = true});
  const auto bytes = [&] {
    writer.commit();
    const h5::File now = h5::File::open(file("run.h5"), h5::Access::read);
    return now.root().dataset("particles/all/image/value").bytes_per_number();
  };
  write_up_to(writer, 200);
  EXPECT_EQ(bytes(), 2u);
  write_up_to(writer, 201);
  EXPECT_EQ(bytes(), 4u);
  writer.close();
  auto again = TrajectoryWriter::append_to(file("run.h5"), 150);
  write_up_to(again, 300);
  again.close();
  const TrajectoryReader reader(file("run.h5"));
  ASSERT_EQ(reader.frames(), 300u);
  for (std::uint64_t k = 0; k < 300; ++k) expect_same_bits(reader.read(k), frame(k));
}

TEST_F(TrajectoryFile, SinglePrecisionRoundsTheNumbersOfParticlesOnce) {
  const TrajectoryOptions options{.velocities = true, .single_precision = true};
  const Configuration3 solids = random_solids(9, 4);
  TrajectoryWriter writer =
      TrajectoryWriter::create(file("run.h5"), solids, some_provenance(), options);
  writer.write(solids, 0);
  writer.close();
  const TrajectoryReader reader(file("run.h5"));
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
    auto writer = TrajectoryWriter::create(file("run.h5"), random_configuration(particles, 0),
                                           some_provenance(), options);
    const auto before = fs::file_size(file("run.h5"));
    for (std::uint64_t k = 0; k < frames; ++k)
      writer.write(random_configuration(particles, k), static_cast<std::int64_t>(k));
    writer.close();
    return static_cast<double>(fs::file_size(file("run.h5")) - before) / frames / particles;
  };
  constexpr double room = 1.5;  // for step, time, box and the index of the chunks
  EXPECT_LT(bytes_per_particle({.velocities = true}), 70 + room);
  EXPECT_LT(bytes_per_particle({.velocities = true, .single_precision = true}), 38 + room);
  EXPECT_LT(bytes_per_particle({.single_precision = true}), 22 + room);
}

// A copy of the file in the middle of a run is what a killed process leaves behind.
TEST_F(TrajectoryFile, ACopyTakenDuringTheRunIsCompleteAndCanBeContinued) {
  auto writer = TrajectoryWriter::create(file("run.h5"), random_configuration(12, 0),
                                         some_provenance(), with_everything);
  for (std::uint64_t k = 0; k <= 70; ++k) {
    if (k % 10 == 0) {
      writer.commit();
      fs::copy_file(file("run.h5"), file("copy.h5"), fs::copy_options::overwrite_existing);
      EXPECT_EQ(TrajectoryReader(file("copy.h5")).frames(), k);
      auto continued = TrajectoryWriter::append_to(file("copy.h5"), k);
      write_frames(continued, k, k + 3);
      continued.close();
      expect_frames(file("copy.h5"), k + 3);
    }
    write_frames(writer, k, k + 1);
  }
}

TEST_F(TrajectoryFile, TruncatedFilesGiveOneMessageAndNoCrash) {
  write_run(file("run.h5"), 4);
  const std::string whole = contents(file("run.h5"));
  for (double part : {0.0, 0.001, 0.01, 0.1, 0.5, 0.9, 0.999}) {
    std::ofstream(file("cut.h5"), std::ios::binary | std::ios::trunc)
        .write(whole.data(), static_cast<std::streamsize>(part * whole.size()));
    const std::string message = file_error([&] { TrajectoryReader(file("cut.h5")).read(3); });
    EXPECT_THAT(message, HasSubstr(file("cut.h5").string() + ": "));
    const auto is_empty = HasSubstr("is empty"), is_cut = HasSubstr("the file is truncated");
    EXPECT_THAT(message, testing::AnyOf(is_empty, is_cut));
    if (part == 0) {
      EXPECT_THAT(message, is_empty);
    }
    if (part >= 0.1) {
      EXPECT_THAT(message, is_cut);
    }
    EXPECT_THAT(file_error([&] { TrajectoryWriter::append_to(file("cut.h5"), 1); }),
                HasSubstr(file("cut.h5").string()));
  }
}

// Zeros over a piece in the middle: an error or the right numbers, never a crash or wrong numbers.
TEST_F(TrajectoryFile, DamagedFilesNeverGiveWrongNumbers) {
  write_run(file("run.h5"), 4);
  const std::string whole = contents(file("run.h5"));
  const Configuration2 right = random_configuration(12, 3);
  int failures = 0;
  for (std::size_t begin = 0; begin + 512 <= whole.size(); begin += 512) {
    std::string damaged = whole;
    std::fill_n(damaged.begin() + begin, 512, '\0');
    std::ofstream(file("damaged.h5"), std::ios::binary | std::ios::trunc) << damaged;
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
TEST_F(TrajectoryFile, AFlippedBitIsHarmlessOrNoticed) {
  write_run(file("run.h5"), 4);
  const std::string whole = contents(file("run.h5"));
  const Configuration2 right = TrajectoryReader(file("run.h5")).read<2>(3);
  Stream draw(3, Purpose::tests);
  int noticed = 0;
  for (int k = 0; k < 1000; ++k) {
    std::string damaged = whole;
    damaged[draw.below(whole.size())] ^= static_cast<char>(1 << draw.below(8));
    std::ofstream(file("damaged.h5"), std::ios::binary | std::ios::trunc) << damaged;
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

TEST_F(TrajectoryFile, MissingAndForeignFiles) {
  EXPECT_THAT(file_error([&] { TrajectoryReader(file("absent.h5")); }),
              HasSubstr("absent.h5: cannot open the file: No such file"));
  std::ofstream(file("text.h5")) << "not HDF5 but long enough to look at\n";
  EXPECT_THAT(file_error([&] { TrajectoryReader(file("text.h5")); }),
              HasSubstr("is not recognised as H5MD, GSD"));
  std::ofstream(file("binary.h5")) << "not" << '\0' << "HDF5";
  EXPECT_THAT(file_error([&] { TrajectoryReader(file("binary.h5")); }), HasSubstr("it is binary"));
  h5::File::create(file("empty.h5")).close();
  EXPECT_THAT(file_error([&] { TrajectoryReader(file("empty.h5")); }),
              HasSubstr("has no group particles"));
}

// A regular file in place of a folder stops even root.
TEST_F(TrajectoryFile, UnwritableFolderIsNamed) {
  std::ofstream(file("plain")) << "x";
  const fs::path path = file("plain") / "run.h5";
  EXPECT_THAT(file_error([&] { write_run(path, 1); }), HasSubstr(path.string()));
  EXPECT_THAT(file_error([&] { write_run(file("absent") / "run.h5", 1); }),
              HasSubstr("No such file or directory"));
}

TEST_F(TrajectoryFile, AFileBeingWrittenCanBeReadButHasOneWriter) {
  auto writer = TrajectoryWriter::create(file("run.h5"), random_configuration(12, 0),
                                         some_provenance(), with_everything);
  write_frames(writer, 0, 3);
  writer.commit();
  const TrajectoryReader reader(file("run.h5"));
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
  EXPECT_THAT(file_error([&] { TrajectoryWriter::append_to(file("run.h5"), 0); }),
              HasSubstr("run.h5: cannot open the file: another program has it open"));
  writer.close();
  EXPECT_TRUE(TrajectoryReader(file("run.h5")).import_report().empty());
  expect_frames(file("run.h5"), 200);
}

// As HDF5 itself locks them; nothing in such a file tells its states apart.
TEST_F(TrajectoryFile, AFileThatAnotherProgramWritesIsRefused) {
  write_run(file("run.h5"), 2);
  const int other = open(file("run.h5").c_str(), O_RDWR);
  ASSERT_EQ(flock(other, LOCK_EX | LOCK_NB), 0);
  EXPECT_THAT(file_error([&] { TrajectoryReader reader(file("run.h5")); }),
              HasSubstr("run.h5: cannot open the file: another program has it open"));
  static_cast<void>(close(other));
}

/// The least that H5MD and this program ask for, as another program may write it: two-dimensional,
/// a fixed box given by its lengths with the origin in a corner, single step and time increments.
void write_foreign_file(const fs::path& path, bool with_semiaxes) {
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
  if (with_semiaxes)
    particles.create_array<double>("semiaxes", {2, 2}, std::array{2.0, 1.0, 1.0, 1.0});
  file.close();
}

TEST_F(TrajectoryFile, ReadsWhatOtherProgramsWrite) {
  write_foreign_file(file("foreign.h5"), true);
  const TrajectoryReader reader(file("foreign.h5"));
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

TEST_F(TrajectoryFile, StepsAndBoxCrossingsMustBeWholeNumbersOfAFewDigits) {
  const auto message_about = [&](double step, double image) {
    fs::remove(file("foreign.h5"));
    write_foreign_file(file("foreign.h5"), true);
    h5::File written = h5::File::open(file("foreign.h5"), h5::Access::write);
    h5::Group particles = written.root().group("particles/water");
    particles.create_group("image").create_array<double>(
        "value", {2, 2, 2}, std::array{0., 0., 0., image, 0., 0., 0., 0.});
    particles.dataset("position/step").set_attribute("offset", step);
    written.close();
    return file_error([&] { TrajectoryReader(file("foreign.h5")).read(0); });
  };
  EXPECT_EQ(message_about(3, -1), "(no FileError)");
  for (const double wrong : {double{NAN}, double{INFINITY}, 1e300}) {
    EXPECT_THAT(message_about(wrong, 0), HasSubstr("but should be a whole number"));
    EXPECT_THAT(message_about(0, wrong),
                HasSubstr(std::isfinite(wrong) ? "frame 0: image has impossible numbers"
                                               : "not finite in frame 0"));
  }
}

TEST_F(TrajectoryFile, MassesAndSpeciesMustMakeSense) {
  const auto message_about = [&](const std::array<double, 2>& masses,
                                 const std::array<std::int32_t, 2>& species) {
    fs::remove(file("foreign.h5"));
    write_foreign_file(file("foreign.h5"), true);
    h5::File written = h5::File::open(file("foreign.h5"), h5::Access::write);
    h5::Group particles = written.root().group("particles/water");
    particles.create_array<double>("mass", {2}, masses);
    particles.create_array<std::int32_t>("species", {2}, species);
    written.close();
    return file_error([&] { TrajectoryReader(file("foreign.h5")); });
  };
  EXPECT_EQ(message_about({1, 2}, {0, 1}), "(no FileError)");
  for (const double mass : {0., -1., double{NAN}, double{INFINITY}})
    EXPECT_THAT(message_about({1, mass}, {0, 0}),
                testing::AnyOf(HasSubstr("frame 0: the mass of particle 1 is "),
                               HasSubstr("water/mass has numbers that are not finite")));
  EXPECT_EQ(message_about({1, 1}, {2'147'483'647, -1}), "(no FileError)");
  EXPECT_EQ(TrajectoryReader(file("foreign.h5")).species_names(),
            (std::vector<std::string>{"-1", "2147483647"}));
}

// Made longer, they would be zero in the frames that are missing.
TEST_F(TrajectoryFile, SeriesThatLackFramesAreNotContinued) {
  write_run(file("whole.h5"), 4);
  for (const std::string name :
       {"particles/all/position/value", "particles/all/position/time", "particles/all/angle/value",
        "particles/all/image/value", "particles/all/box/edges/value", "observables/energy/value"}) {
    fs::copy_file(file("whole.h5"), file("short.h5"), fs::copy_options::overwrite_existing);
    h5::File written = h5::File::open(file("short.h5"), h5::Access::write);
    written.root().dataset(name).resize(2);
    written.close();
    EXPECT_THAT(file_error([&] { TrajectoryWriter::append_to(file("short.h5"), 3); }),
                HasSubstr("short.h5: the dataset " + name + " has fewer frames than step"));
    EXPECT_EQ(file_error([&] { TrajectoryWriter::append_to(file("short.h5"), 2); }),
              "(no FileError)");
  }
}

TEST_F(TrajectoryFile, ASeriesOfAnotherShapeIsNotContinued) {
  const auto message_about = [&](const std::string& name, const h5::Shape& shape) {
    fs::remove(file("run.h5"));
    write_run(file("run.h5"), 1);
    h5::File written = h5::File::open(file("run.h5"), h5::Access::write);
    const auto [parent, child] = std::pair(fs::path(name).parent_path(), fs::path(name).filename());
    h5::Group group = written.root().group(parent);
    group.remove(child);
    group.create_array<double>(child, shape, std::vector<double>(shape.empty() ? 1 : 12));
    written.close();
    return file_error([&] { TrajectoryWriter::append_to(file("run.h5"), 1); });
  };
  EXPECT_THAT(message_about("observables/energy/value", {}),
              HasSubstr("run.h5: the dataset observables/energy/value should have one entry per"));
  EXPECT_THAT(message_about("particles/all/position/value", {12}),
              HasSubstr("position/value should have the shape frames × particles × 3"));
}

TEST_F(TrajectoryFile, AnAttributeThatIsNoSingleStringIsRefused) {
  write_run(file("run.h5"), 1);
  h5::File written = h5::File::open(file("run.h5"), h5::Access::write);
  written.root().group("parameters").set_attribute("author", std::vector<std::string>(100, "a"), 1);
  written.close();
  EXPECT_THAT(file_error([&] { TrajectoryReader(file("run.h5")); }),
              testing::AllOf(HasSubstr("run.h5: "), HasSubstr("author"),
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

TEST_F(TrajectoryFile, ReadsSolidsThatOtherProgramsWrite) {
  write_foreign_solid(file("foreign.h5"), 1);
  const Configuration3 frame = read_state<3>(file("foreign.h5"));
  EXPECT_EQ(frame.box.lengths(), Vec3(4, 5, 6));
  EXPECT_EQ(frame.position[0], Vec3(1, 2, -2.5));
  EXPECT_EQ(frame.shape[0].semi_axes, Vec3(3, 1, 2));
  EXPECT_NEAR(frame.orientation[0].norm(), 1, 4e-16);
  write_foreign_solid(file("foreign.h5"), 1.001);
  EXPECT_THAT(file_error([&] { read_state<3>(file("foreign.h5")); }),
              HasSubstr("the orientation of particle 0 has the norm 1.00099"));
}

// The first of the frames at fault is named, counted from 0.
TEST_F(TrajectoryFile, TimesMustBeFiniteAndForMotionAscend) {
  const auto message_about = [&](const std::vector<double>& times) {
    TrajectoryWriter writer = TrajectoryWriter::create(file("times.h5"), random_configuration(3, 0),
                                                       {}, {.overwrite = true});
    for (const double time : times) {
      Configuration2 frame = random_configuration(3, 0);
      frame.time = time;
      writer.write(frame, 0);
    }
    writer.close();
    std::string obstacle;
    const std::string error =
        file_error([&] { obstacle = TrajectoryReader(file("times.h5")).obstacle_to_motion(); });
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

TEST_F(TrajectoryFile, AMissingDatasetIsNamed) {
  write_foreign_file(file("foreign.h5"), false);
  const std::string message = file_error([&] { TrajectoryReader(file("foreign.h5")); });
  EXPECT_THAT(message, HasSubstr("foreign.h5: frame 0: has no sizes: it has no dataset semiaxes"));
}

/// A real file system of the given size; needs the right to mount.
class SmallDisk : public Files {
 protected:
  void SetUp() override {
    fs::create_directory(disk_ = file("disk"));
    if (mount("tmpfs", disk_.c_str(), "tmpfs", 0, "size=4m") != 0)
      GTEST_SKIP() << "mounting a small tmpfs is not permitted here";
    mounted_ = true;
  }
  void TearDown() override {
    if (mounted_) umount2(disk_.c_str(), MNT_DETACH);
  }
  /// Leaves `bytes` free, in whole pages.
  void fill(std::uint64_t bytes) {
    const std::uint64_t free = fs::space(disk_).available;
    std::ofstream(disk_ / "filler") << std::string(free > bytes ? free - bytes : 0, 'x');
  }

  fs::path disk_;
  bool mounted_ = false;
};

TEST_F(SmallDisk, WhenFullTheFramesBeforeAreKeptAndTheRunGoesOnLater) {
  const fs::path path = disk_ / "run.h5";
  fill(3'000'000);
  std::uint64_t frames = 0;
  {
    auto writer = TrajectoryWriter::create(path, random_configuration(500, 0), some_provenance(),
                                           with_everything);
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

  fs::remove(disk_ / "filler");
  auto writer = TrajectoryWriter::append_to(path, frames);
  write_frames(writer, frames, frames + 2, 500);
  writer.close();
  expect_frames(path, frames + 2, 500);
}

TEST_F(SmallDisk, CreatingWithoutSpaceLeavesNothing) {
  for (const std::uint64_t free : {0, 4096, 16384, 65536, 131072}) {
    fill(free);
    const std::string message = file_error(
        [&] { write_state(disk_ / "state.h5", random_configuration(1500, 0), some_provenance()); });
    EXPECT_THAT(message, HasSubstr("No space left on device")) << free;
    EXPECT_FALSE(fs::exists(disk_ / "state.h5"));
    EXPECT_THAT(partial_files(disk_), IsEmpty());
    fs::remove(disk_ / "filler");
  }
  write_state(disk_ / "state.h5", random_configuration(1500, 0), some_provenance());
  expect_same_bits(read_state(disk_ / "state.h5"), random_configuration(1500, 0));
}

Checkpoint some_checkpoint(std::uint64_t step) {
  Checkpoint checkpoint;
  Configuration2 configuration = random_configuration(9, step);
  configuration.velocity[0] = {-0.0, std::numeric_limits<double>::denorm_min()};
  checkpoint.configuration = configuration;
  checkpoint.reals = {{"virial", 1.0 / 3}, {"Δ", -0.0}, {"next sample", HUGE_VAL}};
  checkpoint.counters = {{"collisions", step}, {"most", std::numeric_limits<std::uint64_t>::max()}};
  checkpoint.series = {{"φ", {0.1, -0.0, HUGE_VAL}}, {"none", {}}};
  checkpoint.texts = {{"empty", ""}, {"reason", "it was\nso"}};
  checkpoint.parameters = "[dynamics]\nduration = 10\n";
  return checkpoint;
}

void expect_same(const Checkpoint& x, const Checkpoint& y) {
  expect_same_bits(std::get<Configuration2>(x.configuration),
                   std::get<Configuration2>(y.configuration));
  EXPECT_EQ(x.counters, y.counters);
  EXPECT_EQ(x.series, y.series);
  EXPECT_EQ(x.texts, y.texts);
  EXPECT_EQ(x.parameters, y.parameters);
  ASSERT_EQ(x.reals.size(), y.reals.size());
  for (const auto& [name, value] : x.reals)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(y.reals.at(name)));
}

TEST_F(TrajectoryFile, KeepsTheClosePairsOfEveryFrame) {
  const auto flat = [](std::uint64_t k) {
    return with_close_pairs(random_configuration(12, k), k);
  };
  const TrajectoryOptions soft{.velocities = true, .close_pairs = true};
  auto writer = TrajectoryWriter::create(file("soft.h5"), flat(0), some_provenance(), soft);
  for (std::uint64_t k = 0; k < 4; ++k) writer.write(flat(k), static_cast<std::int64_t>(k));
  writer.close();
  // Continued after two frames, with others than before.
  auto again = TrajectoryWriter::append_to(file("soft.h5"), 2);
  again.write(with_close_pairs(random_configuration(12, 2), 0), 2);
  again.write(flat(3), 3);
  again.close();
  const TrajectoryReader reader(file("soft.h5"));
  for (const std::uint64_t k : {0, 1, 3}) {
    expect_same_bits(reader.read(k), flat(k));
    expect_same_close_pairs(reader.read(k), flat(k));
  }
  EXPECT_TRUE(reader.read(2).close_pairs.empty());
  const Configuration3 solids = with_close_pairs(random_solids(12, 0), 5);
  write_state(file("state.h5"), solids, some_provenance());
  expect_same_close_pairs(read_state<3>(file("state.h5")), solids);
}

// The file has what a particle in contact will do after it.
TEST_F(TrajectoryFile, VelocitiesAreThoseAfterContact) {
  Configuration2 c = random_configuration(12, 0);
  c.releases = {{3, 4, 1.5, {7, 8}}};
  write_state(file("state.h5"), c, some_provenance());
  const Configuration2 read = read_state(file("state.h5"));
  EXPECT_EQ(read.velocity[3], Vec2(7, 8));
  EXPECT_EQ(read.velocity[4], c.velocity[4]);
  EXPECT_EQ(mechanics(read).momentum, mechanics(c).momentum);
}

TEST_F(CheckpointFile, ComesBackBitByBit) {
  EXPECT_FALSE(checkpoint_exists(file("run.checkpoint")));
  save_checkpoint(file("run.checkpoint"), some_checkpoint(1));
  EXPECT_TRUE(checkpoint_exists(file("run.checkpoint")));
  const LoadedCheckpoint loaded = load_checkpoint(file("run.checkpoint"));
  EXPECT_EQ(loaded.warning, "");
  expect_same(loaded.checkpoint, some_checkpoint(1));
  save_checkpoint(file("bare"), {});
  expect_same(load_checkpoint(file("bare")).checkpoint, {});
}

TEST_F(CheckpointFile, TheOneBeforeIsKeptAndTakenIfTheNewestIsCutShort) {
  const fs::path path = file("run.checkpoint");
  for (std::uint64_t step : {1, 2, 3}) save_checkpoint(path, some_checkpoint(step));
  expect_same(load_checkpoint(path).checkpoint, some_checkpoint(3));
  EXPECT_THAT(partial_files(path.parent_path()), IsEmpty());
  for (const auto size : {fs::file_size(path) - 1, fs::file_size(path) / 2, std::uintmax_t{0}}) {
    fs::resize_file(path, size);
    const LoadedCheckpoint loaded = load_checkpoint(path);
    expect_same(loaded.checkpoint, some_checkpoint(2));
    EXPECT_THAT(loaded.warning,
                testing::AnyOf(HasSubstr(path.string() + ": cannot open"),
                               HasSubstr(path.string() + ": is damaged: its checksum is missing")));
    EXPECT_THAT(loaded.warning, HasSubstr("run.checkpoint.previous"));
  }
  // Killed between the two renames.
  fs::remove(path);
  expect_same(load_checkpoint(path).checkpoint, some_checkpoint(2));
  EXPECT_TRUE(checkpoint_exists(path));
  fs::resize_file(file("run.checkpoint.previous"), 100);
  EXPECT_THAT(file_error([&] { load_checkpoint(path); }), HasSubstr("unreadable too"));
  fs::remove(file("run.checkpoint.previous"));
  EXPECT_THAT(file_error([&] { load_checkpoint(path); }), HasSubstr("no earlier checkpoint"));
}

// The checkpoint itself, or the one before with a warning, or a refusal of both.
TEST_F(CheckpointFile, AFlippedBitIsHarmlessOrNoticed) {
  const fs::path path = file("run.checkpoint");
  for (std::uint64_t step : {1, 2}) save_checkpoint(path, some_checkpoint(step));
  const std::string whole = contents(path);
  Stream draw(3, Purpose::tests);
  int noticed = 0;
  for (int k = 0; k < 1000; ++k) {
    std::string damaged = whole;
    damaged[draw.below(whole.size())] ^= static_cast<char>(1 << draw.below(8));
    std::ofstream(path, std::ios::binary | std::ios::trunc) << damaged;
    const LoadedCheckpoint loaded = load_checkpoint(path);
    noticed += !loaded.warning.empty();
    expect_same(loaded.checkpoint, some_checkpoint(loaded.warning.empty() ? 2 : 1));
    ASSERT_FALSE(HasFailure()) << k;
  }
  EXPECT_GT(noticed, 100);
}

TEST_F(CheckpointFile, OfThreeDimensionsComesBackBitByBit) {
  Checkpoint checkpoint;
  checkpoint.configuration = random_solids(9, 1);
  save_checkpoint(file("c"), checkpoint);
  expect_same_bits(std::get<Configuration3>(load_checkpoint(file("c")).checkpoint.configuration),
                   random_solids(9, 1));
}

// Checkpoints of version 0.1 have no checksum.
TEST_F(CheckpointFile, ContactsOfParticlesThatAreNotThereAreDamage) {
  Checkpoint checkpoint;
  checkpoint.configuration = with_close_pairs(random_configuration(9, 1), 2);
  const auto message_about = [&](double particle) {
    fs::remove(file("c"));
    save_checkpoint(file("c"), checkpoint);
    h5::File written = h5::File::open(file("c"), h5::Access::write);
    written.root().set_attribute<std::int32_t>("checkpoint_layout", 3);
    h5::Dataset pairs = written.root().dataset("configuration/close_pairs");
    std::vector<double> rows = pairs.read<double>();
    rows[0] = particle;
    pairs.write<double>(rows);
    written.close();
    return file_error([&] { load_checkpoint(file("c")); });
  };
  EXPECT_EQ(message_about(0), "(no FileError)");
  for (const double wrong : {-1., 0.5, 9., 1e300, double{NAN}, double{INFINITY}})
    EXPECT_THAT(message_about(wrong), HasSubstr("is damaged: it has contacts of particles"));
}

TEST_F(CheckpointFile, IsRemovedWithTheOneBefore) {
  const fs::path path = file("run.checkpoint");
  for (std::uint64_t step : {1, 2}) save_checkpoint(path, some_checkpoint(step));
  remove_checkpoint(path);
  EXPECT_FALSE(checkpoint_exists(path));
  remove_checkpoint(path);
}

TEST_F(CheckpointFile, ATrajectoryIsNone) {
  write_run(file("run.h5"), 1);
  EXPECT_THAT(file_error([&] { load_checkpoint(file("run.h5")); }), HasSubstr("not a checkpoint"));
}

TEST_F(CheckpointFile, UnwritableFolderIsNamed) {
  std::ofstream(file("plain")) << "x";
  EXPECT_THAT(file_error([&] { save_checkpoint(file("plain") / "c", some_checkpoint(1)); }),
              HasSubstr((file("plain") / "c").string()));
}

TEST_F(SmallDisk, AFailedCheckpointLeavesBothFilesIntact) {
  const fs::path path = disk_ / "run.checkpoint";
  save_checkpoint(path, some_checkpoint(1));
  save_checkpoint(path, some_checkpoint(2));
  const std::string newest = contents(path), before = contents(disk_ / "run.checkpoint.previous");
  for (const std::uint64_t free : {0, 4096, 8192}) {
    fill(free);
    const std::string message = file_error([&] { save_checkpoint(path, some_checkpoint(3)); });
    EXPECT_THAT(message, HasSubstr("No space left on device")) << free;
    EXPECT_EQ(contents(path), newest);
    EXPECT_EQ(contents(disk_ / "run.checkpoint.previous"), before);
    EXPECT_THAT(partial_files(disk_), IsEmpty());
    fs::remove(disk_ / "filler");
  }
  save_checkpoint(path, some_checkpoint(3));
  expect_same(load_checkpoint(path).checkpoint, some_checkpoint(3));
}

}  // namespace
}  // namespace vitrel
