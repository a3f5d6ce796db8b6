#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/state/stage.h"

namespace vitrel {

/// The formats that trajectories and states are exported to, in two dimensions and in three (packing.h);
/// each is the usual suffix too.
extern const std::vector<std::string> trajectory_formats, packing_formats;

struct ExportRequest {
  std::filesystem::path input;   ///< trajectory or state
  std::string format;            ///< one of the formats of its dimension
  std::filesystem::path output;  ///< must not exist
  std::optional<std::string> frames =
      {};  ///< which ones, as FrameRange reads it; all, of packings the last
  std::optional<double> shrink = {};       ///< of packings: all semi-axes times this, up to 1; 1
  std::optional<std::size_t> voxels = {};  ///< of vti: along the longest edge; 100
};

struct ExportedTrajectory {
  std::uint64_t frames = 0;
  std::size_t particles = 0;
  std::size_t bodies = 0;  ///< of a packing: images included
  std::uintmax_t bytes = 0;
};

/// Copies the frames, one in memory at a time; the output appears under its name when it is
/// complete. Nothing if the run control stopped it: then there is no output. Throws UserError and
/// FileError.
std::optional<ExportedTrajectory> export_trajectory(const ExportRequest& request,
                                                    const RunControl& control);

}  // namespace vitrel
