#include "edmd/instances/instances.h"
#include "edmd/simulation.h"

namespace vitrel {

template <>
GrowingEllipse body_from<GrowingEllipse>(const Ellipse& shape, const CommonSize& common) {
  return {shape, common.size, common.growth_rate};
}

template class Simulation<GrowingEllipse>;

std::unique_ptr<Engine> make_growing_engine(const EngineOptions& options) {
  return std::make_unique<Simulation<GrowingEllipse>>(
      options, "growing ellipses, since semi-axes change with time");
}

}  // namespace vitrel
