#pragma once

#include "tests/support/scenes.h"
#include "tests/support/solids.h"

/// States of equal bodies.
namespace vitrel {

/// So many bodies of one shape at the origin of a box with these sides.
template <int Dim>
Configuration<Dim> equal_bodies(std::size_t n, const ParticleShape<Dim>& shape,
                                const Vec<Dim>& sides = Vec<Dim>::Ones()) {
  Configuration<Dim> c;
  c.resize(n);
  c.shape.assign(n, shape);
  c.box = PeriodicBox<Dim>(sides);
  return c;
}

inline Configuration2 square_lattice(int side, double packing_fraction, double angle,
                                     const Ellipse& shape) {
  return square_lattice(side, packing_fraction, angle, [&](std::size_t) { return shape; });
}

inline Configuration2 lattice_of_disks(int side, double packing_fraction) {
  return square_lattice(side, packing_fraction, 0, Ellipse{1, 1});
}

inline Configuration3 cubic_lattice(int side, double packing_fraction, const Ellipsoid& shape,
                                    std::uint64_t seed = 1) {
  const auto shape_of = [&](std::size_t) { return shape; };
  return cubic_lattice(side, packing_fraction, shape_of, seed);
}

}  // namespace vitrel
