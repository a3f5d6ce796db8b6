#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/vector.h"
#include "core/state/species.h"

namespace vitrel {

struct SystemParameters {
  int dimension = 2;
  std::int64_t particles = 1000;
  double packing_fraction = 0.5;
  std::uint64_t seed = 1;
  ShapeDraw draw = ShapeDraw::quantiles;
  /// The other sides of the box over L_x; a single number holds for all of them.
  std::vector<double> box_aspect = {1};
};

/// The sides of the box over L_x, the first of which is 1.
template <int Dim>
Vec<Dim> box_proportions(const SystemParameters& system) {
  Vec<Dim> proportions = Vec<Dim>::Constant(system.box_aspect[0]);
  for (std::size_t k = 1; k < system.box_aspect.size(); ++k)
    proportions[static_cast<Eigen::Index>(k) + 1] = system.box_aspect[k];
  proportions[0] = 1;
  return proportions;
}

}  // namespace vitrel
