#pragma once

#include "edmd/simulation_state.h"

namespace vitrel {

/// The next event of a particle.
template <Body B>
struct alignas(32) Event {
  enum class Type : std::uint8_t {
    collision,
    overlap,    ///< the pair overlaps already
    exit,       ///< the particle leaves its neighbourhood
    repredict,  ///< nothing happens, but the particle is predicted again
  };
  using State = SimulationState<B>;
  using Vector = typename State::Vector;

  /// The contact normal of bodies that are not round; for round bodies it is the line of centres.
  struct ContactNormal {
    Vector value = Vector::Zero();
  };
  struct Empty {};

  Type type = Type::repredict;
  std::uint32_t partner_version = 0;
  typename State::Image partner;
  [[no_unique_address]] std::conditional_t<State::is_round, Empty, ContactNormal> normal;

  static Event with(Type type, const typename State::Image& partner, std::uint32_t version,
                    const Vector& normal) {
    Event event{type, version, partner, {}};
    if constexpr (!State::is_round) event.normal.value = normal;
    return event;
  }
  Vector normal_along(const Vector& separation) const {
    if constexpr (State::is_round)
      return normalized(separation);
    else
      return normal.value;
  }
};

/// An event and its time.
template <Body B>
struct TimedEvent {
  double time = SimulationState<B>::never;
  Event<B> event;
};

}  // namespace vitrel
