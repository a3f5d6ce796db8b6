#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "edmd/simulation_state.h"
#include "edmd/time_text.h"

namespace vitrel {

/// Detects inelastic collapse: infinitely many collisions of a few particles in a finite time, or of one pair, like a
/// bouncing ball, whose rotation brings the surfaces together again. The criterion is that the distances travelled
/// between collisions stay below the contact gap several times in a row.
///
/// Collapse ends a run, unless it uses the contact-time model (luding1998): a collision within the time t_c after the
/// previous one of either particle is elastic and smooth, as it would be if contacts took that long and the particles
/// were still in touch. The effect of the model is small if t_c is well below the time between collisions.
template <Body B>
class InelasticCollapse {
 public:
  using Index = typename SimulationState<B>::Index;

  explicit InelasticCollapse(const SimulationState<B>& state) : state_(state) {}

  void begin_block() { count_.assign(state_.size(), 0); }

  /// Registers a collision before which the surfaces moved by this displacement. Throws InvariantError if the particles
  /// collapse.
  void detect(Index i, Index j, double displacement) {
    for (const Index k : {i, j})
      count_[k] =
          std::abs(displacement) < state_.contact_gap ? std::min(count_[k] + 1, max_count) : 0;
    if (std::min(count_[i], count_[j]) == max_count) report(i, j);
  }

 private:
  static constexpr int max_count = 10;

  [[noreturn]] void report(Index i, Index j) const {
    throw InvariantError(
        "inelastic collapse at " + time_text(state_.base + state_.now) + ": particles " +
        std::to_string(state_.external_id[i]) + " and " + std::to_string(state_.external_id[j]) +
        " collide repeatedly without moving; dynamics.contact_duration, the t_c of the "
        "contact-time model, "
        "goes on from here; or use a coefficient of restitution closer to 1, or a shorter run");
  }

  const SimulationState<B>& state_;
  std::vector<std::uint8_t> count_;  // consecutive collisions without progress
};

}  // namespace vitrel
