#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/trajectory.h"

namespace vitrel {

/// The unwrapped path of one particle, one entry per frame.
struct Track {
  std::vector<double> x, y, angle;
};

/// Bytes that the track of one particle takes.
inline std::size_t track_bytes(std::size_t frames) {
  return 3 * sizeof(double) * frames;
}

/// Tracks of the particles begin … end − 1, from one pass over the frames. `tell` hears how much of it
/// is done, 0 … 1.
std::vector<Track> read_tracks(Trajectory& trajectory, std::size_t begin, std::size_t end,
                               const std::function<void(double)>& tell);

}  // namespace vitrel
