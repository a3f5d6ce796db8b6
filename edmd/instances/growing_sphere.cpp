#include "edmd/instances/instances.h"
#include "edmd/simulation.h"

namespace vitrel {

template class Simulation<GrowingSphere>;

std::unique_ptr<Engine3> make_growing_sphere_engine(const EngineOptions& options) {
  return std::make_unique<Simulation<GrowingSphere>>(
      options, "growing spheres without orientation, since radii change with time");
}

}  // namespace vitrel
