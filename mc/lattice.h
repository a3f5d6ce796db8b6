#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/options.h"

namespace vitrel {

/// Puts all particles on lattice sites, row by row; empty sites are spread evenly. The arrangements are
///
/// - square: columns × rows of equal square cells, with all particles at `angle`, or each at its own angle;
/// - triangular: the densest packing of disks, stretched along x like the particles; equal particles go up to
///   φ = π/√12 = 0.9069;
/// - cubic, face_centred, body_centred: cubic lattices, stretched along the axes like the particles, all of which lie
///   along the axes of the box; equal particles go up to φ = π/6, π/√18 = 0.7405 and π√3/8 = 0.6802.
///
/// `angle` must be 0 on all but the square lattice. Stretched lattices give every particle a cell that fits the longest
/// semi-axis of any particle along each direction.
///
/// The numbers of columns, rows and layers are chosen for few empty sites and for a box close to the given one. Then
/// the sides of the box change, at the same area (volume), so that the lattice fits exactly. The report's reason gives
/// the numbers of columns, rows, layers and empty sites. Random angles come from the stream (seed, placement, 0,
/// particle). Throws UserError, with the packing fraction that would do, if particles would overlap.
template <int Dim>
StageReport place_on_lattice(Configuration<Dim>& configuration, const LatticeOptions& options,
                             std::uint64_t seed = 0);

/// Returns whether this arrangement exists in this dimension.
constexpr bool has_dimension(Arrangement arrangement, int dimension) {
  return (arrangement <= Arrangement::triangular) == (dimension == 2);
}

}  // namespace vitrel
