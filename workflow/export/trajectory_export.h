#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/foreign/foreign_file.h"
#include "core/state/stage.h"

namespace vitrel {

/// The formats to which trajectories and states are exported:
///
///     gsd, xyz, csv      the particles of every frame (gsd.h, text_formats.h)
///     xytheta            the particles of every frame, in the plane only (text_formats.h)
///     geo, vti, vtp      in space only: one period with all images that meet the box (packing.h); csv
///                        with `images` contains them too. For several frames vtp makes a folder,
///                        a ParaView series; the other formats of this line take one frame.
struct ExportFormat {
  std::string name;
  bool in_the_plane, in_space;
};
/// All formats.
const std::vector<ExportFormat>& export_formats();

struct ExportRequest {
  std::filesystem::path input;   ///< a trajectory or a state
  std::string format;            ///< the name of a format that exists in the dimension of the input
  std::filesystem::path output;  ///< must not exist
  /// The frames for FrameRange. By default all, or the last if the format takes one frame.
  std::optional<std::string> frames = {};
  /// Factor of all semi-axes for packings, at most 1; by default 1.
  std::optional<double> shrink = {};
  std::optional<std::size_t> voxels = {};  ///< for vti: along the longest edge; 100 by default
  bool images = false;                     ///< for csv in space: includes images
  KnownSystem known = {};                  ///< for files of other programs
};

struct ExportedTrajectory {
  std::uint64_t frames = 0;
  std::size_t particles = 0;
  std::size_t bodies = 0;  ///< for packings: including images
  std::uintmax_t bytes = 0;
  /// True for csv of a packing, a file of one frame in space, without its images.
  bool omits_images = false;
  ImportReport import = {};
};

/// The output beside the input: with the format as its suffix (.dat for xytheta) or, for a series, the folder
/// `<input>_vtp`. Ignores `output`. Throws UserError and FileError.
std::filesystem::path default_output(const ExportRequest& request);

/// Copies the frames, holding one in memory at a time. The output appears under its name when it is complete. If the
/// run control stops the export, there is no output, and the result is empty. Throws UserError and FileError.
std::optional<ExportedTrajectory> export_trajectory(const ExportRequest& request,
                                                    const RunControl& control);

}  // namespace vitrel
