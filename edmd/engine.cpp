#include "edmd/engine.h"

#include "core/error.h"
#include "edmd/instances/instances.h"

namespace vitrel {

namespace {

template <int Dim>
void require_round(const Configuration<Dim>& configuration, const EngineOptions& options) {
  if (options.soft_contact && (options.growth_rate != 0 || rotor_count(configuration) > 0))
    throw UserError("soft particles must be round and cannot grow");
}

}  // namespace

std::unique_ptr<Engine2> make_engine(const Configuration2& configuration,
                                     const EngineOptions& options) {
  require_round(configuration, options);
  if (options.growth_rate != 0) return make_growing_ellipse_engine(options);
  return rotor_count(configuration) == 0 ? make_disk_engine(options) : make_ellipse_engine(options);
}

std::unique_ptr<Engine3> make_engine(const Configuration3& configuration,
                                     const EngineOptions& options) {
  require_round(configuration, options);
  const bool all_round = rotor_count(configuration) == 0;
  if (options.growth_rate != 0)
    return all_round ? make_growing_sphere_engine(options) : make_growing_ellipsoid_engine(options);
  return all_round ? make_sphere_engine(options) : make_ellipsoid_engine(options);
}

}  // namespace vitrel
