#include "edmd/engine.h"

#include "edmd/instances/instances.h"

namespace vitrel {

std::unique_ptr<Engine> make_engine(const Configuration2& configuration,
                                    const EngineOptions& options) {
  if (options.growth_rate != 0) return make_growing_engine(options);
  return rotor_count(configuration) == 0 ? make_disk_engine(options) : make_ellipse_engine(options);
}

}  // namespace vitrel
