// A checkpoint comes back bit-identical, or the one before it does, whatever happens to the newest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/io/checkpoint.h"
#include "core/io/h5md.h"
#include "core/random/stream.h"
#include "tests/support/files.h"
#include "tests/support/small_disk.h"
#include "tests/support/stored_frames.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

class CheckpointFile : public Files {
 protected:
  const fs::path path_ = file("run.checkpoint"), previous_ = file("run.checkpoint.previous");
};

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

void save_checkpoints(const fs::path& path, std::uint64_t last_step) {
  for (std::uint64_t step = 1; step <= last_step; ++step)
    save_checkpoint(path, some_checkpoint(step));
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

std::string load_error(const fs::path& path) {
  return file_error([&] { load_checkpoint(path); });
}

TEST_F(CheckpointFile, ComesBackBitByBit) {
  EXPECT_FALSE(checkpoint_exists(path_));
  save_checkpoint(path_, some_checkpoint(1));
  EXPECT_TRUE(checkpoint_exists(path_));
  const LoadedCheckpoint loaded = load_checkpoint(path_);
  EXPECT_EQ(loaded.warning, "");
  expect_same(loaded.checkpoint, some_checkpoint(1));
  save_checkpoint(file("bare"), {});
  expect_same(load_checkpoint(file("bare")).checkpoint, {});
}

TEST_F(CheckpointFile, OfThreeDimensionsComesBackBitByBit) {
  Checkpoint checkpoint;
  checkpoint.configuration = random_solids(9, 1);
  save_checkpoint(path_, checkpoint);
  expect_same_bits(std::get<Configuration3>(load_checkpoint(path_).checkpoint.configuration),
                   random_solids(9, 1));
}

TEST_F(CheckpointFile, TheOneBeforeIsKeptAndTakenIfTheNewestIsCutShort) {
  save_checkpoints(path_, 3);
  expect_same(load_checkpoint(path_).checkpoint, some_checkpoint(3));
  EXPECT_THAT(partial_files(folder_), IsEmpty());
  for (const auto size : {fs::file_size(path_) - 1, fs::file_size(path_) / 2, std::uintmax_t{0}}) {
    fs::resize_file(path_, size);
    const LoadedCheckpoint loaded = load_checkpoint(path_);
    expect_same(loaded.checkpoint, some_checkpoint(2));
    EXPECT_THAT(loaded.warning, testing::AnyOf(HasSubstr(path_.string() + ": cannot open"),
                                               HasSubstr(path_.string() +
                                                         ": is damaged: its checksum is missing")));
    EXPECT_THAT(loaded.warning, HasSubstr("run.checkpoint.previous"));
  }
  // Killed between the two renames.
  fs::remove(path_);
  expect_same(load_checkpoint(path_).checkpoint, some_checkpoint(2));
  EXPECT_TRUE(checkpoint_exists(path_));
  fs::resize_file(previous_, 100);
  EXPECT_THAT(load_error(path_), HasSubstr("unreadable too"));
  fs::remove(previous_);
  EXPECT_THAT(load_error(path_), HasSubstr("no earlier checkpoint"));
}

// The checkpoint itself, or the one before with a warning, or a refusal of both.
TEST_F(CheckpointFile, AFlippedBitIsHarmlessOrNoticed) {
  save_checkpoints(path_, 2);
  const std::string whole = contents(path_);
  Stream draw(3, Purpose::tests);
  int noticed = 0;
  for (int k = 0; k < 1000; ++k) {
    overwrite(path_, with_a_flipped_bit(whole, draw));
    const LoadedCheckpoint loaded = load_checkpoint(path_);
    noticed += !loaded.warning.empty();
    expect_same(loaded.checkpoint, some_checkpoint(loaded.warning.empty() ? 2 : 1));
    ASSERT_FALSE(HasFailure()) << k;
  }
  EXPECT_GT(noticed, 100);
}

// Checkpoints of version 0.1 have no checksum.
TEST_F(CheckpointFile, ContactsOfParticlesThatAreNotThereAreDamage) {
  Checkpoint checkpoint;
  checkpoint.configuration = with_close_pairs(random_configuration(9, 1), 2);
  const auto message_about = [&](double particle) {
    fs::remove(path_);
    save_checkpoint(path_, checkpoint);
    h5::File written = h5::File::open(path_, h5::Access::write);
    written.root().set_attribute<std::int32_t>("checkpoint_layout", 3);
    h5::Dataset pairs = written.root().dataset("configuration/close_pairs");
    std::vector<double> rows = pairs.read<double>();
    rows[0] = particle;
    pairs.write<double>(rows);
    written.close();
    return load_error(path_);
  };
  EXPECT_EQ(message_about(0), "(no FileError)");
  for (const double wrong : {-1., 0.5, 9., 1e300, double{NAN}, double{INFINITY}})
    EXPECT_THAT(message_about(wrong), HasSubstr("is damaged: it has contacts of particles"));
}

TEST_F(CheckpointFile, IsRemovedWithTheOneBefore) {
  save_checkpoints(path_, 2);
  remove_checkpoint(path_);
  EXPECT_FALSE(checkpoint_exists(path_));
  remove_checkpoint(path_);
}

TEST_F(CheckpointFile, ATrajectoryIsNone) {
  write_run(file("run.h5"), 1);
  EXPECT_THAT(load_error(file("run.h5")), HasSubstr("not a checkpoint"));
}

TEST_F(CheckpointFile, UnwritableFolderIsNamed) {
  overwrite(file("plain"), "x");
  EXPECT_THAT(file_error([&] { save_checkpoint(file("plain") / "c", some_checkpoint(1)); }),
              HasSubstr((file("plain") / "c").string()));
}

class CheckpointOnASmallDisk : public SmallDisk {};

TEST_F(CheckpointOnASmallDisk, AFailedCheckpointLeavesBothFilesIntact) {
  const fs::path path = disk_ / "run.checkpoint", previous = disk_ / "run.checkpoint.previous";
  save_checkpoints(path, 2);
  const std::string newest = contents(path), before = contents(previous);
  for (const std::uint64_t free : {0, 4096, 8192}) {
    expect_no_space(free, [&] { save_checkpoint(path, some_checkpoint(3)); });
    EXPECT_EQ(contents(path), newest);
    EXPECT_EQ(contents(previous), before);
    empty();
  }
  save_checkpoint(path, some_checkpoint(3));
  expect_same(load_checkpoint(path).checkpoint, some_checkpoint(3));
}

}  // namespace
}  // namespace vitrel
