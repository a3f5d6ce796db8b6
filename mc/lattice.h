#pragma once

#include "core/state/configuration.h"

namespace vitrel {

enum class Arrangement { square, triangular };

/// square: columns × rows of equal rectangular cells in the box as it is, all particles at `angle`.
/// triangular: the densest packing of disks, stretched along x like the particles; the sides of the
/// box change (its area does not) so that whole rows fit, and `angle` must be 0. Every particle
/// gets a cell that fits the longest and the widest one; equal particles go up to φ = π/√12 =
/// 0.9069.
struct LatticeOptions {
  Arrangement arrangement = Arrangement::square;
  double angle = 0;
};

/// Puts all particles on lattice sites, row by row; sites left over stay empty. Throws UserError,
/// with the packing fraction that would do, if particles would overlap.
void place_on_lattice(Configuration2& configuration, const LatticeOptions& options);

/// The largest packing fraction at which equal ellipses at `angle` fit a square lattice of square
/// cells without overlap; κ = √3 at π/4 reaches π/(2√3).
double densest_square_lattice(const Ellipse& shape, double angle);

}  // namespace vitrel
