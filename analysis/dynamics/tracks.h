#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/trajectory.h"

namespace vitrel {

/// One number per frame.
using FrameSeries = std::vector<double>;

/// The path of one particle.
template <int Dim>
struct Track {
  static constexpr std::size_t orientation_numbers = Dim == 2 ? 1 : 4;

  std::array<FrameSeries, Dim> position;  ///< unwrapped
  /// The angle in the plane, or the quaternion w, x, y, z in space.
  std::array<FrameSeries, orientation_numbers> orientation;
  double turn_period = 0;  ///< period of the angle; 0: it is unwrapped
};

/// Returns the bytes that the track of one particle takes.
template <int Dim>
std::size_t track_bytes(std::size_t frames) {
  return (Dim + Track<Dim>::orientation_numbers) * sizeof(double) * frames;
}

/// Reads the tracks of the particles begin … end − 1 in one pass over the frames. `tell` is called with the share that
/// is done, 0 … 1.
template <int Dim>
std::vector<Track<Dim>> read_tracks(Trajectory<Dim>& trajectory, std::size_t begin, std::size_t end,
                                    const std::function<void(double)>& tell);

}  // namespace vitrel
