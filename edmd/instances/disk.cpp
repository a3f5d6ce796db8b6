#include "edmd/instances/instances.h"
#include "edmd/simulation.h"

namespace vitrel {

template <>
Disk shape_from<Disk>(const Ellipse& semi_axes) {
  return {semi_axes.a};
}

template <>
Disk body_from<Disk>(const Disk& shape, const CommonSize&) {
  return shape;
}

template class Simulation<Disk>;

std::unique_ptr<Engine> make_disk_engine(const EngineOptions& options) {
  return std::make_unique<Simulation<Disk>>(
      options, "disks without orientation, since every particle is round");
}

}  // namespace vitrel
