#include "edmd/instances/instances.h"
#include "edmd/simulation.h"

namespace vitrel {

template class Simulation<Disk>;

std::unique_ptr<Engine2> make_disk_engine(const EngineOptions& options) {
  return std::make_unique<Simulation<Disk>>(
      options, std::string("disks") + rotation_of_round(options) + neighbor_text(options));
}

}  // namespace vitrel
