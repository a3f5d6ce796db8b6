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
  /// More frames than this are thinned evenly, and those of more than 5000 particles to still fewer (frames_for in
  /// frame_observable.h). With 0 only the order is measured.
  std::size_t max_frames = 1000;
  ShellOptions shells;
  PairCorrelationOptions pairs;
};

}  // namespace vitrel
