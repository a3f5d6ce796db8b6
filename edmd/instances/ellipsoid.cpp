#include "edmd/instances/instances.h"
#include "edmd/simulation.h"

namespace vitrel {

template class Simulation<Ellipsoid>;

std::unique_ptr<Engine3> make_ellipsoid_engine(const EngineOptions& options) {
  return std::make_unique<Simulation<Ellipsoid>>(
      options, "rotating ellipsoids, since some particle is not round");
}

}  // namespace vitrel
