#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"

namespace vitrel {

/// Random sequential insertion: particles, the largest first, are put one after another at random
/// places and angles where they meet none of those before, and are never moved.
struct InsertionOptions {
  double packing_fraction = 0.3;     ///< to insert at; the box is scaled to it
  std::uint64_t attempts = 1000000;  ///< for one particle, before insertion is called hopeless
  bool aligned = false;              ///< all angles 0 instead of random ones
};

/// `stuck` with a reason if a particle found no place, `stopped` if the budget said so; the
/// configuration then is not to be used, and the same call makes it anew.
/// The jamming limit is near φ = 0.547 for disks and 0.583 for ellipses.
StageReport insert_particles(Configuration2& configuration, const InsertionOptions& options,
                             std::uint64_t seed, const Budget& budget);

}  // namespace vitrel
