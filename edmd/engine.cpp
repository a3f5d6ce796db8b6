#include "edmd/engine.h"

#include <algorithm>

#include "core/elementary.h"
#include "core/error.h"
#include "core/neighbors/cell_neighbors.h"
#include "edmd/instances/instances.h"

namespace vitrel {

namespace {

template <int Dim>
void require_round(const Configuration<Dim>& configuration, const EngineOptions& options) {
  if (are_soft(options) && (options.growth_rate != 0 || rotor_count(configuration) > 0))
    throw UserError("soft particles must be round and cannot grow");
}

/// Cells cost less than lists while a cell of minimum width holds fewer particles than this: up to a packing fraction
/// of 0.36 for equal disks and 0.22 for equal spheres, the lowest values measured on any machine
/// (docs/studies/engine.md). The limit is lower in systems that exceed the caches, because the event loop prefetches
/// lists but not cells.
double max_particles_per_cell(std::size_t particles) {
  constexpr std::size_t cached_particles = 32768;
  return particles <= cached_particles ? 0.56 : 0.32;
}

template <int Dim>
EngineOptions with_neighbor_search(const Configuration<Dim>& configuration, EngineOptions options) {
  if (options.neighbors) return options;
  double max_radius = 0;
  for (const ParticleShape<Dim>& shape : configuration.shape)
    max_radius = std::max(max_radius, shape.circumradius());
  const double per_cell = static_cast<double>(configuration.size()) / configuration.box.volume() *
                          power(min_cell_width(max_radius), Dim);
  const bool is_gas = cells_fit(configuration.box, max_radius) &&
                      per_cell < max_particles_per_cell(configuration.size());
  options.neighbors = is_gas ? NeighborSearch::cells : NeighborSearch::lists;
  return options;
}

}  // namespace

std::unique_ptr<Engine2> make_engine(const Configuration2& configuration,
                                     const EngineOptions& options) {
  require_round(configuration, options);
  if (options.growth_rate != 0) return make_growing_ellipse_engine(options);
  return rotor_count(configuration) == 0
             ? make_disk_engine(with_neighbor_search(configuration, options))
             : make_ellipse_engine(options);
}

std::unique_ptr<Engine3> make_engine(const Configuration3& configuration,
                                     const EngineOptions& options) {
  require_round(configuration, options);
  const bool all_round = rotor_count(configuration) == 0;
  if (options.growth_rate != 0)
    return all_round ? make_growing_sphere_engine(options) : make_growing_ellipsoid_engine(options);
  if (all_round) return make_sphere_engine(with_neighbor_search(configuration, options));
  const bool some_scalene = std::ranges::any_of(configuration.shape, &ParticleShape<3>::is_scalene);
  return options.rotation == FreeRotation::euler && some_scalene
             ? make_tumbling_ellipsoid_engine(options)
             : make_ellipsoid_engine(options);
}

}  // namespace vitrel
