// Exports: which frames, and what is refused. The content is compared in tests/clients.

#include <algorithm>

#include "analysis/results.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "tests/app/end_to_end.h"
#include "tests/support/partial_files.h"
#include "workflow/export/frame_range.h"
#include "workflow/export/trajectory_export.h"

namespace vitrel {
namespace {

std::vector<std::uint64_t> chosen(const std::string& text, std::uint64_t frames) {
  return FrameRange(text).of(frames, "run.h5");
}

std::string refusal(const std::string& text, std::uint64_t frames) {
  try {
    chosen(text, frames);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

/// Disks on a line, in `frames` frames.
void write_run(const fs::path& path, std::size_t particles, int frames) {
  Configuration2 configuration;
  configuration.box = PeriodicBox<2>(Vec2(3.0 * static_cast<double>(particles), 10));
  configuration.resize(particles);
  configuration.species_names = {"A"};
  for (std::size_t i = 0; i < particles; ++i) {
    configuration.position[i].x() = 3.0 * static_cast<double>(i);
    configuration.shape[i].b = 1 / (1 + 1e-5 * static_cast<double>(i));
  }
  auto writer = TrajectoryWriter::create(path, configuration, current_provenance("", "", 1));
  for (int k = 0; k < frames; ++k) {
    configuration.time = k;
    writer.write(configuration, k);
  }
  writer.close();
}

// The right side is what Python gives for list(range(n))[text].
TEST(FrameRange, ReadsTheNotationOfPython) {
  EXPECT_THAT(chosen(":", 3), ElementsAre(0, 1, 2));
  EXPECT_THAT(chosen("1", 3), ElementsAre(1));
  EXPECT_THAT(chosen("-1", 3), ElementsAre(2));
  EXPECT_THAT(chosen("-3", 3), ElementsAre(0));
  EXPECT_THAT(chosen("2:5", 7), ElementsAre(2, 3, 4));
  EXPECT_THAT(chosen("1:6:2", 7), ElementsAre(1, 3, 5));
  EXPECT_THAT(chosen("::3", 7), ElementsAre(0, 3, 6));
  EXPECT_THAT(chosen("-2:", 7), ElementsAre(5, 6));
  EXPECT_THAT(chosen(":-5", 7), ElementsAre(0, 1));
  EXPECT_THAT(chosen("-100:100", 2), ElementsAre(0, 1));
  EXPECT_THAT(chosen("::9223372036854775807", 3), ElementsAre(0));
}

TEST(FrameRange, SaysWhyItSelectsNothing) {
  const std::string none = "selects nothing: run.h5 has 3 frame(s), counted from 0";
  for (const std::string text :
       {"3", "-4", "9223372036854775807", "2:2", "2:1", "3:", ":-3", "-9223372036854775808"})
    EXPECT_EQ(refusal(text, 3), "--frames " + text + ": " + none);
  EXPECT_THAT(refusal(":", 0), HasSubstr("has 0 frame(s)"));
}

TEST(FrameRange, RefusesWhatIsNoRange) {
  for (const std::string text :
       {"", "x", "1-3", "1:2:3:4", "1.5", " 1", "0:9:x", "99999999999999999999"})
    EXPECT_THAT(refusal(text, 3), HasSubstr("one frame or first:end:step")) << text;
  for (const std::string text : {"::0", "5:0:-1"})
    EXPECT_THAT(refusal(text, 9), HasSubstr("a step below 1"));
}

TEST(Export, NamesTheFileAfterTheInputAndSaysWhatItDid) {
  const Folder folder("export_summary");
  write_run(folder / "run.h5", 5, 4);
  const auto summary = folder.summary("export run.h5 --to csv --frames 1:");
  expect_values(summary, {{"output", "run.csv"}, {"frames", 3}, {"particles", 5}});
  EXPECT_EQ(summary["bytes"], fs::file_size(folder / "run.csv"));
}

TEST(Export, RefusesWithOneMessageAndLeavesNothing) {
  const Folder folder("export_refusals");
  write_run(folder / "run.h5", 5, 4);
  write_results(folder / "results.h5", {{{"t", "", {{"time", "time", {1, 2}, {}}}}}, {}});
  folder.write("there.xyz", "kept");
  folder.expect_refusals(
      {{"export -q run.h5 --to pdf", 2, "'pdf' is none of gsd, xyz, csv, xytheta, geo, vti, vtp"},
       {"export -q run.h5 --to xyz -o there.xyz", 2, "exists already"},
       {"export -q run.h5 --to xyz --frames 4", 2, "has 4 frame(s)"},
       {"export -q there.xyz --to gsd", 3, "is not recognised as H5MD, GSD, extended XYZ,"},
       {"export -q nowhere.h5 --to gsd", 3, "nowhere.h5"},
       {"export -q run.h5 --to gsd -o nowhere/run.gsd", 3, "nowhere/run.gsd"},
       {"export -q results.h5 --to csv", 3, "has no group particles"}});
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder.path()))
    left.push_back(entry.path().filename().string());
  EXPECT_THAT(left, testing::UnorderedElementsAre("results.h5", "run.h5", "standard_error",
                                                  "standard_output", "there.xyz"));
}

TEST(Export, GsdKeepsASpeciesOfSeveralShapes) {
  const Folder folder("export_shapes");
  write_run(folder / "run.h5", 5, 2);
  export_trajectory({folder / "run.h5", "gsd", folder / "run.gsd"}, {});
  const TrajectoryReader before(folder / "run.h5"), after(folder / "run.gsd");
  const Configuration2 written = before.read<2>(1), read = after.read<2>(1);
  EXPECT_EQ(read.species_names, written.species_names);
  EXPECT_EQ(read.species, written.species);
  for (std::size_t i = 0; i < written.size(); ++i) EXPECT_EQ(read.shape[i], written.shape[i]) << i;
}

/// A frame per time, of one sphere that grows with it.
void write_packing(const fs::path& path, int frames) {
  Configuration3 packing;
  packing.box = PeriodicBox<3>(Vec3(4, 4, 4));
  packing.resize(1);
  packing.species_names = {"A"};
  packing.position[0] = {1.5, 0, 0};
  auto writer = TrajectoryWriter::create(path, packing, current_provenance("", "", 1));
  for (int k = 0; k < frames; ++k) {
    packing.time = k;
    packing.position[0].y() = 0.1 * k;
    writer.write(packing, k);
  }
  writer.close();
}

TEST(Export, LeavesNothingIfStopped) {
  const Folder folder("export_stopped");
  write_run(folder / "flat.h5", 5, 4);
  write_packing(folder / "run.h5", 4);
  const auto expect = [&](const std::string& input, const std::string& format) {
    int frames = 0;
    const RunControl control{[&] { return frames == 2; }, [&](const Progress&) { ++frames; }, {}};
    EXPECT_FALSE(export_trajectory({folder / input, format, folder / "output"}, control));
    EXPECT_EQ(frames, 2);
    EXPECT_FALSE(fs::exists(folder / "output"));
    EXPECT_THAT(partial_files(folder.path()), IsEmpty());
  };
  expect("flat.h5", "gsd");
  expect("run.h5", "gsd");
  expect("run.h5", "vtp");
}

TEST(ExportOfAPacking, IsOfOneFrameTheLastUnlessTold) {
  const Folder folder("packing_frames");
  write_packing(folder / "run.h5", 3);
  const auto lines = [&](const std::string& options, const std::string& file) {
    folder.succeed("export run.h5 --to csv --images -q " + options + " -o " + file);
    const std::string text = folder.read(file);
    return text.substr(text.find('\n') + 1);
  };
  // The body reaches beyond x = 2, and its image from there.
  const std::string last = lines("", "last.csv");
  EXPECT_EQ(last,
            "0,A,-1,0,0,-2.5,0.2,0,1,1,1,1,0,0,0,4,4,4\n"
            "0,A,0,0,0,1.5,0.2,0,1,1,1,1,0,0,0,4,4,4\n");
  EXPECT_EQ(lines("--frames -1", "a.csv"), last);
  EXPECT_THAT(lines("--frames 0", "b.csv"), HasSubstr("1.5,0,0"));
  EXPECT_THAT(lines("--shrink 0.4", "c.csv"), "0,A,0,0,0,1.5,0.2,0,0.4,0.4,0.4,1,0,0,0,4,4,4\n");
}

TEST(ExportOfAPacking, SaysThatCsvHasNoImages) {
  const Folder folder("packing_csv");
  write_packing(folder / "state.h5", 1);
  write_packing(folder / "run.h5", 2);
  const Outcome state = folder.run("export state.h5 --to csv");
  const Outcome run = folder.run("export run.h5 --to csv");
  EXPECT_EQ(state.code, 0);
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(state.errors, HasSubstr("state.csv: has the particles of a packing without"));
  EXPECT_THAT(run.errors, Not(HasSubstr("packing")));
}

TEST(ExportOfAPacking, MakesASeriesOfSeveralFrames) {
  const Folder folder("packing_series");
  write_packing(folder / "run.h5", 3);
  const auto made = [&](const std::string& options) {
    const auto summary = folder.summary("export run.h5 --to vtp " + options);
    const fs::path output = folder / summary["output"].get<std::string>();
    std::vector<std::string> files;
    std::uintmax_t bytes = 0;
    for (const auto& file : fs::directory_iterator(output)) {
      files.push_back(file.path().filename().string());
      bytes += file.file_size();
    }
    EXPECT_EQ(summary["bytes"], bytes);
    EXPECT_EQ(summary["frames"], files.size() - 1);
    std::sort(files.begin(), files.end());
    return files;
  };
  EXPECT_THAT(made(""),
              ElementsAre("frame_0000.vtp", "frame_0001.vtp", "frame_0002.vtp", "run.pvd"));
  EXPECT_TRUE(fs::is_directory(folder / "run_vtp"));
  EXPECT_THAT(made("--frames ::2 -o some/"),
              ElementsAre("frame_0000.vtp", "frame_0002.vtp", "run.pvd"));
  folder.succeed("export run.h5 --to vtp --frames 1 -q");
  EXPECT_TRUE(fs::is_regular_file(folder / "run.vtp"));
}

TEST(ExportOfAPacking, RefusesWhatDoesNotFit) {
  const Folder folder("packing_refused");
  write_packing(folder / "run.h5", 3);
  write_run(folder / "flat.h5", 2, 1);
  const auto message = [&](const std::string& options) {
    const Outcome outcome = folder.run("export " + options);
    EXPECT_EQ(outcome.code, 2) << options;
    return outcome.errors;
  };
  for (const auto& [options, part] :
       {std::pair("run.h5 --to csv --images --frames :",
                  "selects 3 frames, but --to csv --images takes one"),
        {"run.h5 --to geo --frames 1:", "selects 2 frames, but --to geo takes one"},
        {"run.h5 --to vti --frames 1:", "selects 2 frames, but --to vti takes one"},
        {"run.h5 --to vtp -o run.vtp", "make a folder"},
        {"run.h5 --to csv --voxels 7", "is for --to vti"},
        {"run.h5 --to geo --shrink 1.5", "--shrink"},
        {"flat.h5 --to csv --shrink 0.5", "three dimensions"},
        {"flat.h5 --to vti",
         "flat.h5: is two-dimensional, for which --to takes gsd, xyz, csv, xytheta, but not vti\n"},
        {"run.h5 --to xytheta",
         "run.h5: is three-dimensional, for which --to takes gsd, xyz, csv, geo, vti, vtp, but not "
         "xytheta\n"},
        {"run.h5 --to pdf", "'pdf' is none of gsd, xyz, csv"},
        // What belongs to the images is not there without them.
        {"run.h5 --to csv --shrink 0.5", "--images"},
        {"flat.h5 --to xyz --images", "--to csv in three dim"},
        {"run.h5 --to xyz --images", "--to csv in three dim"}})
    EXPECT_THAT(message(options), HasSubstr(part)) << options;
}

}  // namespace
}  // namespace vitrel
