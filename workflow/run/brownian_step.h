#pragma once

#include <string>

/// @file
/// How long a step of Brownian dynamics is: √(kT/m) τ_B over the mean gap, the distance that a particle flies between two
/// collisions. The limit of short steps is that of overdamped motion (scala2007); `scripts/validate brownian_step` measures
/// how far relaxation times are from it.
namespace vitrel {

/// Beyond this many mean gaps, relaxation takes ten per cent longer and more.
inline constexpr double longest_step_in_gaps = 1.5;

/// `rate`: the collisions that a particle has per unit of time.
inline double step_in_gaps(double brownian_step, double rate) {
  return brownian_step * rate;
}

/// Says that a step is too long; empty if it is not.
std::string long_step_text(double brownian_step, double rate);

}  // namespace vitrel
