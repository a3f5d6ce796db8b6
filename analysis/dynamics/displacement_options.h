#pragma once

#include <cstddef>
#include <vector>

#include "analysis/dynamics/time_axis.h"
#include "core/parallel.h"

namespace vitrel {

/// The parts of the motion of particles that are measured; the others are left empty.
struct MotionParts {
  bool displacement = true;  ///< moments of displacements and rotations
  bool scattering = true, orientation = true, overlap = true;
};

struct DisplacementOptions {
  MotionParts parts = {};
  TimeAxisOptions axis = {};
  /// q of F_s and F; if empty, that of main_wave_number alone.
  std::vector<double> wave_numbers = {};
  /// n of L_n; if empty, 2 and 4 in the plane, 1 and 2 in space.
  std::vector<double> orders = {};
  std::vector<double> waiting_times = {};     ///< for ageing (ageing.h)
  double overlap_distance = 0.3;              ///< a of the overlap Q
  std::size_t memory = std::size_t{1} << 30;  ///< maximum of bytes for particle tracks
  int threads = all_cores;                    ///< maximum number; the result does not depend on it
};

}  // namespace vitrel
