#include "edmd/instances/instances.h"
#include "edmd/simulation.h"

namespace vitrel {

template class Simulation<Sphere>;

std::unique_ptr<Engine3> make_sphere_engine(const EngineOptions& options) {
  return std::make_unique<Simulation<Sphere>>(
      options, std::string("spheres") + rotation_of_round(options) + neighbor_text(options));
}

}  // namespace vitrel
