// How the work of commands grows with the length of a run, by counts of what they ask of the libraries and of the
// system.
#include <dlfcn.h>
#include <fftw3.h>
#include <hdf5.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "core/io/h5md.h"
#include "core/random/stream.h"
#include "tests/app/end_to_end.h"
#include "workflow/analyze/analyze.h"
#include "workflow/export/trajectory_export.h"
#include "workflow/storage/check.h"

namespace {

using Counts = std::map<std::string, std::uint64_t>;
Counts counts;

/// The function that the one of this name stands before.
template <class Function>
Function* counted(const char* name) {
  ++counts[name];
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// NOLINTBEGIN(readability-inconsistent-declaration-parameter-name)
extern "C" {
herr_t H5Dread(hid_t set, hid_t type, hid_t memory, hid_t file, hid_t how, void* numbers) {
  return counted<decltype(H5Dread)>("H5Dread")(set, type, memory, file, how, numbers);
}
herr_t H5Dget_chunk_storage_size(hid_t set, const hsize_t* at, hsize_t* bytes) {
  return counted<decltype(H5Dget_chunk_storage_size)>("H5Dget_chunk_storage_size")(set, at, bytes);
}
herr_t H5Dget_chunk_info_by_coord(hid_t set, const hsize_t* at, unsigned* skipped, haddr_t* address,
                                  hsize_t* bytes) {
  return counted<decltype(H5Dget_chunk_info_by_coord)>("H5Dget_chunk_info_by_coord")(
      set, at, skipped, address, bytes);
}
void fftw_execute(fftw_plan plan) {
  counted<decltype(fftw_execute)>("fftw_execute")(plan);
}
ssize_t pread(int file, void* bytes, std::size_t count, off_t offset) {
  return counted<decltype(pread)>("pread")(file, bytes, count, offset);
}
}
// NOLINTEND(readability-inconsistent-declaration-parameter-name)

namespace vitrel {
namespace {

class Growth : public testing::Test {
 protected:
  /// Twenty ellipses that wander about their places.
  fs::path run_of(std::uint64_t frames) const {
    const fs::path path = folder_ / (std::to_string(frames) + ".h5");
    if (fs::exists(path)) return path;
    Configuration2 state;
    state.box = PeriodicBox<2>(Vec2(50, 40));
    state.resize(20);
    state.species_names = {"A"};
    state.shape.assign(20, Ellipse{2, 0.5});
    auto writer =
        TrajectoryWriter::create(path, state, current_provenance("", "", 1), {.velocities = true});
    Stream draw(1, Purpose::tests);
    for (std::uint64_t k = 0; k < frames; ++k) {
      state.time = 0.1 * static_cast<double>(k);
      for (std::size_t i = 0; i < 20; ++i) {
        const Vec2 place(10.0 * static_cast<double>(i % 5) - 20,
                         10.0 * static_cast<double>(i / 5) - 15);
        const double right = draw.uniform();
        const double up = draw.uniform();
        state.position[i] = place + Vec2(right, up);
        state.angle[i] += 0.1 * draw.normal();
        state.velocity[i] = {draw.normal(), draw.normal()};
      }
      writer.write(state, static_cast<std::int64_t>(k));
    }
    writer.close();
    return path;
  }

  using Command = std::function<void(const fs::path&)>;
  Counts counts_of(const Command& command, std::uint64_t frames) const {
    const fs::path path = run_of(frames);
    counts.clear();
    command(path);
    return counts;
  }

  /// Every count of a run four times as long is at most four times as large.
  void expect_linear(const Command& command) const {
    const Counts few = counts_of(command, 500), many = counts_of(command, 2000);
    EXPECT_GT(many.at("H5Dread"), 0u);
    EXPECT_EQ(many.contains("H5Dget_chunk_info_by_coord"), false);  // it walks the whole index
    for (const auto& [name, count] : many) {
      const std::uint64_t before = few.contains(name) ? few.at(name) : 0;
      EXPECT_LE(count, 4 * before) << name;
    }
  }

  const Folder folder_{"growth"};
};

TEST_F(Growth, AnalysisIsLinearInFrames) {
  expect_linear([](const fs::path& run) { analyze_run(run, {}); });
}

TEST_F(Growth, CheckIsLinearInFrames) {
  expect_linear([](const fs::path& run) {
    EXPECT_EQ(check_file<2>(TrajectoryReader(run), false, {}).overlaps, 0u);
  });
}

TEST_F(Growth, ExportIsLinearInFrames) {
  expect_linear([&](const fs::path& run) {
    const ExportRequest request{.input = run, .format = "xyz", .output = folder_ / "run.xyz"};
    export_trajectory(request, {});
    fs::remove(request.output);
  });
}

// A frame takes part of a read, not several: chunks are read once, whatever is read of them.
TEST_F(Growth, AChunkIsReadOnce) {
  const Counts found = counts_of(
      [](const fs::path& run) {
        const TrajectoryReader reader(run);
        Configuration2 state;
        for (std::uint64_t k = 0; k < reader.frames(); ++k) reader.read(k, state);
      },
      2000);
  // Positions, images, angles, velocities, angular velocities and edges in sixteen chunks each, and what frames share.
  EXPECT_LE(found.at("H5Dread"), 6 * 16 + 20u);
}

}  // namespace
}  // namespace vitrel
