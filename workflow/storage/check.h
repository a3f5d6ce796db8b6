#pragma once

#include <string>
#include <vector>

#include "core/io/h5md.h"
#include "core/state/check.h"
#include "core/state/configuration.h"
#include "core/state/stage.h"

/// @file
/// The exact check of files: overlaps and integrity of saved states.
namespace vitrel {

template <int Dim>
struct FileCheck {
  std::uint64_t frames = 0;       ///< looked at
  std::uint64_t overlaps = 0;     ///< over all of them
  std::uint64_t close_pairs = 0;  ///< of soft particles, over all of them; no overlaps
  double smallest_gap = 0;        ///< over all of them; infinity if no two particles are near
  std::uint64_t smallest_gap_frame = 0;
  std::vector<std::string> complaints;  ///< the first few overlaps, with frame, particles and image
  Configuration<Dim> last;              ///< the last frame
};

/// Every frame of a trajectory or state of that dimension, or the last only. The run control may stop it between frames.
/// Throws FileError if the file is damaged or has no frame.
template <int Dim>
FileCheck<Dim> check_file(const TrajectoryReader& reader, bool last_only,
                          const RunControl& control);

}  // namespace vitrel
