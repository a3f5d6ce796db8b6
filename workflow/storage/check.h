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
  std::uint64_t frames = 0;    ///< checked
  std::uint64_t overlaps = 0;  ///< in all frames checked
  /// Close pairs of soft particles in all frames checked. They do not count as overlaps.
  std::uint64_t close_pairs = 0;
  double smallest_gap = 0;  ///< in all frames checked; infinity if no two particles are near
  std::uint64_t smallest_gap_frame = 0;
  std::vector<std::string> complaints;  ///< the first few overlaps, with frame, particles and image
  Configuration<Dim> last;              ///< the last frame
};

/// Checks every frame, or only the last, of a trajectory or state of this dimension. The run control may stop the
/// check between frames. Throws FileError if the file is damaged or has no frame.
template <int Dim>
FileCheck<Dim> check_file(const TrajectoryReader& reader, bool last_only,
                          const RunControl& control);

}  // namespace vitrel
