#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/state/stage.h"

namespace vitrel {

/// The formats that trajectories and states are exported to; each is the usual suffix too.
extern const std::vector<std::string> trajectory_formats;

struct ExportRequest {
  std::filesystem::path input;   ///< trajectory or state
  std::string format;            ///< one of trajectory_formats
  std::filesystem::path output;  ///< must not exist
  std::string frames = ":";      ///< which ones, as FrameRange reads it
};

struct ExportedTrajectory {
  std::uint64_t frames = 0;
  std::size_t particles = 0;
  std::uintmax_t bytes = 0;
};

/// Copies the frames, one in memory at a time; the output appears under its name when it is
/// complete. Nothing if the budget stopped it: then there is no output. Throws UserError and
/// FileError.
std::optional<ExportedTrajectory> export_trajectory(const ExportRequest& request,
                                                    const Budget& budget);

}  // namespace vitrel
