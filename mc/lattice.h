#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/options.h"

namespace vitrel {

/// square: columns × rows of equal square cells, all particles at `angle`, or each at its own.
/// triangular: the densest packing of disks, stretched along x like the particles; `angle` must
/// be 0. Every particle gets a cell that fits the longest and the widest one; equal particles go up
/// to φ = π/√12 = 0.9069.
/// In both, columns and rows are chosen for few empty sites and for a box close to the given one;
/// then the sides of the box change, at the same area, so that the lattice fits exactly.
///
/// Puts all particles on lattice sites, row by row; empty sites are spread evenly. The report's
/// reason says how many columns, rows and empty sites there are. Random angles come from the stream
/// (seed, placement, 0, particle). Throws UserError, with the packing fraction that would do, if
/// particles would overlap.
StageReport place_on_lattice(Configuration2& configuration, const LatticeOptions& options,
                             std::uint64_t seed = 0);

/// The largest packing fraction at which equal ellipses at `angle` fit a square lattice without
/// overlap; κ = √3 at π/4 reaches π/(2√3).
double densest_square_lattice(const Ellipse& shape, double angle);

}  // namespace vitrel
