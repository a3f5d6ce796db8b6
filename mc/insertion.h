#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"

namespace vitrel {

/// Random sequential insertion: particles, the largest first, are put one after another at random
/// places and orientations where they meet none of those before, and are never moved.
struct InsertionOptions {
  double packing_fraction = 0.3;     ///< to insert at; the box is scaled to it
  std::uint64_t attempts = 1000000;  ///< for one particle, before insertion is called hopeless
  bool aligned = false;              ///< all axes along those of space instead of random ones
};

/// The end of an insertion. With n places tried the dimensionless time of its kinetics is τ = n A/V, A
/// the area of a particle; close to saturation φ∞ − φ ∝ τ^(−1/2) for disks and τ^(−1/3) for
/// other shapes. Sources: swendsen1981, talbot1989.
struct InsertionReport : StageReport {
  std::uint64_t trials = 0;
};

/// `stuck` with a reason if a particle found no place, `stopped` if the control said so; the
/// configuration then is not to be used, and the same call makes it anew.
/// The jamming limit is near φ = 0.547 for disks, 0.583 for ellipses and 0.382 for spheres.
template <int Dim>
InsertionReport insert_particles(Configuration<Dim>& configuration, const InsertionOptions& options,
                                 std::uint64_t seed, const RunControl& control);

}  // namespace vitrel
