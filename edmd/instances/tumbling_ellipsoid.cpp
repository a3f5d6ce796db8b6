#include "edmd/instances/instances.h"
#include "edmd/simulation.h"

namespace vitrel {

template class Simulation<TumblingEllipsoid>;

std::unique_ptr<Engine3> make_tumbling_ellipsoid_engine(const EngineOptions& options) {
  return std::make_unique<Simulation<TumblingEllipsoid>>(
      options, "ellipsoids that tumble by Euler's equations, since some have three different axes");
}

}  // namespace vitrel
