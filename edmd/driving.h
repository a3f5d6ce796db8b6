#pragma once

#include "core/state/configuration.h"
#include "edmd/options.h"

namespace vitrel {

/// Homogeneous driving by random forces, as of a vibrated or fluidised granular gas (vannoije1998): every `interval`
/// each particle is kicked, v += g √(2 P τ N/((N − 1) D m)) with D normal numbers g per particle from the stream (seed,
/// kicks, step, particle), τ the interval and P the power; then Σ m v is brought back to what it was. On average this
/// supplies the energy P per particle and unit of time. Rotations are not kicked. With τ well below the time between
/// collisions it is the white noise ξ₀² = 2P/(D m).
///
/// A single particle is not kicked, since it would keep its momentum. The result does not depend on the number of threads.
template <int Dim>
void kick(Configuration<Dim>& configuration, const Driving& driving, std::uint64_t seed,
          std::uint64_t step, int threads = 1);

}  // namespace vitrel
