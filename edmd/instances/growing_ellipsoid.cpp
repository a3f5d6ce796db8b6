#include "edmd/instances/instances.h"
#include "edmd/simulation.h"

namespace vitrel {

template class Simulation<GrowingEllipsoid>;

std::unique_ptr<Engine3> make_growing_ellipsoid_engine(const EngineOptions& options) {
  return std::make_unique<Simulation<GrowingEllipsoid>>(
      options, "growing ellipsoids of constant angular velocity, since semi-axes change with time");
}

}  // namespace vitrel
