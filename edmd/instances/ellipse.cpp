#include "edmd/instances/instances.h"
#include "edmd/simulation.h"

namespace vitrel {

template <>
Ellipse body_from<Ellipse>(const Ellipse& shape, const CommonSize&) {
  return shape;
}

template class Simulation<Ellipse>;

std::unique_ptr<Engine> make_ellipse_engine(const EngineOptions& options) {
  return std::make_unique<Simulation<Ellipse>>(
      options, "rotating ellipses, since some particle is not round");
}

}  // namespace vitrel
