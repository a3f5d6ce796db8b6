#pragma once

#include <cstdint>

#include "mc/options.h"
#include "core/state/configuration.h"
#include "core/state/stage.h"

namespace vitrel {

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
