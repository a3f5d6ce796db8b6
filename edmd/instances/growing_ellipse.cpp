#include "edmd/instances/instances.h"
#include "edmd/simulation.h"

namespace vitrel {

template class Simulation<GrowingEllipse>;

std::unique_ptr<Engine2> make_growing_ellipse_engine(const EngineOptions& options) {
  return std::make_unique<Simulation<GrowingEllipse>>(
      options, "growing ellipses, since semi-axes change with time");
}

}  // namespace vitrel
