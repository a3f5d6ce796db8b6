#pragma once

#include <algorithm>

#include "mc/insertion.h"
#include "mc/swelling.h"
#include "tests/support/scenes.h"

/// Fluids that several tests begin with.
namespace vitrel {

/// Ellipses of one shape at random places and angles, in a box with L_y/L_x = `box_aspect`.
inline Configuration2 inserted_fluid(std::size_t n, double aspect_ratio, double packing_fraction,
                                     double box_aspect = 1, std::uint64_t seed = 1) {
  Configuration2 c;
  c.resize(n);
  c.box = PeriodicBox<2>(Vec2(1, box_aspect));
  for (Ellipse& shape : c.shape) shape = of_aspect_ratio(aspect_ratio);
  insert_particles(c, {packing_fraction, 100'000, false}, seed, {});
  return c;
}

/// The same, denser than insertion comes: swollen from φ = 0.3.
inline Configuration2 swollen_fluid(std::size_t n, double aspect_ratio, double packing_fraction,
                                    double box_aspect = 1, std::uint64_t seed = 1) {
  Configuration2 c =
      inserted_fluid(n, aspect_ratio, std::min(packing_fraction, 0.3), box_aspect, seed);
  SwellingState state;
  swell(c, {packing_fraction}, seed, state, {});
  return c;
}

}  // namespace vitrel
