#include "edmd/instances/instances.h"
#include "edmd/simulation.h"

namespace vitrel {

template class Simulation<Ellipse>;

std::unique_ptr<Engine2> make_ellipse_engine(const EngineOptions& options) {
  return std::make_unique<Simulation<Ellipse>>(
      options, "rotating ellipses, since some particle is not round");
}

}  // namespace vitrel
