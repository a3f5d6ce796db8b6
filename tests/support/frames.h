#pragma once

#include <utility>
#include <vector>

#include "analysis/trajectory.h"

/// Small trajectories in memory.
namespace vitrel {

/// `count` frames: `change(c, k)` makes the k-th of the one before it, the first of `c`.
template <int Dim, class Change>
MemoryTrajectory<Dim> trajectory_of(std::size_t count, Configuration<Dim> c, Change&& change) {
  std::vector<Configuration<Dim>> frames;
  for (std::size_t k = 0; k < count; ++k) {
    change(c, k);
    frames.push_back(c);
  }
  return MemoryTrajectory<Dim>(std::move(frames));
}

/// Some frames of a trajectory.
template <int Dim>
MemoryTrajectory<Dim> chosen_frames(Trajectory<Dim>& trajectory,
                                    const std::vector<std::size_t>& chosen) {
  std::vector<Configuration<Dim>> frames;
  for (const std::size_t k : chosen) frames.push_back(trajectory.read(k));
  return MemoryTrajectory<Dim>(std::move(frames));
}

}  // namespace vitrel
