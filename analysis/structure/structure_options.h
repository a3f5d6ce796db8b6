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
  std::size_t max_frames = 1000;  ///< evenly thinned beyond; 0: order only
  ShellOptions shells;
  PairCorrelationOptions pairs;
};

}  // namespace vitrel
