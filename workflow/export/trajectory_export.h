#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/foreign/foreign_file.h"
#include "core/state/stage.h"

namespace vitrel {

/// Trajectories and states are exported as
///
///     gsd, xyz, csv      the particles of every frame: gsd.h, text_formats.h
///     xytheta            in the plane, the same: text_formats.h
///     geo, vti, vtp      in space: one period with all images that meet the box, and so csv with
///                        `images` (packing.h). Of several frames vtp makes a folder, a ParaView
///                        series; the others take one frame
struct ExportFormat {
  std::string name;
  bool in_the_plane, in_space;
};
/// All of them.
const std::vector<ExportFormat>& export_formats();

struct ExportRequest {
  std::filesystem::path input;   ///< trajectory or state
  std::string format;            ///< the name of one that has the dimension of the input
  std::filesystem::path output;  ///< must not exist
  std::optional<std::string> frames =
      {};  ///< which ones, as FrameRange reads it; all, or the last where it is one
  std::optional<double> shrink = {};       ///< of packings: all semi-axes times this, up to 1; 1
  std::optional<std::size_t> voxels = {};  ///< of vti: along the longest edge; 100
  bool images = false;                     ///< of csv in space
  KnownSystem known = {};                  ///< of files of other programs
};

struct ExportedTrajectory {
  std::uint64_t frames = 0;
  std::size_t particles = 0;
  std::size_t bodies = 0;  ///< of a packing: images included
  std::uintmax_t bytes = 0;
  bool omits_images =
      false;  ///< csv of a file of one frame in space, a packing, without its images
  ImportReport import = {};
};

/// Beside the input: with the format as its suffix (.dat for xytheta), or, of a series, the folder
/// `<input>_vtp`. Ignores `output`. Throws UserError and FileError.
std::filesystem::path default_output(const ExportRequest& request);

/// Copies the frames, one in memory at a time; the output appears under its name when it is
/// complete. Nothing if the run control stopped it: then there is no output. Throws UserError and
/// FileError.
std::optional<ExportedTrajectory> export_trajectory(const ExportRequest& request,
                                                    const RunControl& control);

}  // namespace vitrel
