#pragma once

#include <cstddef>

namespace vitrel {

struct ShellOptions {
  double wave_number_max = 12;
  double wave_number_step = 0.1;  ///< width of a shell
};

struct PairCorrelationOptions {
  double distance_max = 20;
  double distance_step = 0.05;  ///< width of a bin
};

struct StructureOptions {
  /// Evenly thinned beyond, and of more than 5000 particles to fewer (frames_for in frame_observable.h); 0: order only.
  std::size_t max_frames = 1000;
  ShellOptions shells;
  PairCorrelationOptions pairs;
};

}  // namespace vitrel
