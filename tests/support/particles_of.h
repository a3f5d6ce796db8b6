#pragma once

#include <vector>

#include "core/state/configuration.h"

namespace vitrel {

/// Particles of these shapes at rest at the origin.
template <int Dim>
Configuration<Dim> particles_of(const std::vector<ParticleShape<Dim>>& shapes) {
  Configuration<Dim> c;
  c.resize(shapes.size());
  c.shape = shapes;
  return c;
}

/// The same in a box.
template <int Dim>
Configuration<Dim> particles_of(const std::vector<ParticleShape<Dim>>& shapes,
                                const Vec<Dim>& lengths) {
  Configuration<Dim> c = particles_of<Dim>(shapes);
  c.box = PeriodicBox<Dim>(lengths);
  return c;
}

}  // namespace vitrel
