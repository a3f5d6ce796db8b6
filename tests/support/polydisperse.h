#pragma once

#include "core/state/species.h"
#include "mc/insertion.h"

namespace vitrel {

/// Bodies of one shape at random, whose sizes are uniform between 0.6 and 1.4.
template <int Dim>
Configuration<Dim> polydisperse(double aspect_ratio, std::size_t particles, double fraction) {
  Species species;
  species.aspect_ratio = Distribution{.mean = aspect_ratio};
  species.size = Distribution{.kind = Distribution::Kind::uniform, .low = 0.6, .high = 1.4};
  Configuration<Dim> c = draw_particles<Dim>({species}, particles, fraction, Vec<Dim>::Ones(), 1);
  insert_particles(c, {.packing_fraction = fraction}, 1, {});
  return c;
}

}  // namespace vitrel
