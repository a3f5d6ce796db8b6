#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/options.h"

namespace vitrel {

/// The result of an insertion. After n trials its kinetics has reached the dimensionless time τ = n A/V, where A is the
/// area of a particle; near saturation φ∞ − φ ∝ τ^(−1/2) for disks and τ^(−1/3) for other shapes. Sources:
/// swendsen1981, talbot1989.
struct InsertionReport : StageReport {
  std::uint64_t trials = 0;
};

/// Random sequential insertion: particles, the largest first, are placed one after another at random positions and
/// orientations where they do not overlap earlier ones, and are never moved. With a given orientation tensor, the axis
/// of a particle is drawn once, and only its place is tried again.
///
/// Returns `stalled`, with a reason, if a particle found no place, and `stopped` on request. The configuration is then
/// unusable, and the same call starts again. The jamming limit is near φ = 0.547 for disks, 0.583 for ellipses and
/// 0.382 for spheres.
template <int Dim>
InsertionReport insert_particles(Configuration<Dim>& configuration, const InsertionOptions& options,
                                 std::uint64_t seed, const RunControl& control);

}  // namespace vitrel
