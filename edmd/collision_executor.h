#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "edmd/collision_rule.h"
#include "edmd/correction_move.h"
#include "edmd/engine.h"
#include "edmd/event.h"
#include "edmd/inelastic_collapse.h"

namespace vitrel {

/// Executes collisions of hard particles: new velocities for both.
template <Body B>
class CollisionExecutor {
 public:
  using State = SimulationState<B>;
  using Index = typename State::Index;
  using Vector = typename State::Vector;
  static constexpr int dimension = State::dimension;

  CollisionExecutor(State& state, const EngineOptions& options)
      : state_(state), options_(options) {}

  void begin_block() { collapse_.begin_block(); }

  /// The collision of particle i with the partner of its event. Predictions for both must follow.
  void collide_pair(Index i, const Event<B>& event, RunCounters& counters) {
    const Index j = event.partner.other;
    const double since = state_.now - std::max(state_.last_change(i), state_.last_change(j));
    const Vector d = meet(i, event);
    const Vector normal = event.normal_along(d);
    const double speed = impact(i, j, d, normal, options_.restitution, counters);
    if (options_.restitution < 1) collapse_.detect(i, j, speed * since);
    if constexpr (!State::is_round) state_.neighborhoods->store_axis(i, event.partner, normal);
  }

  /// The correction move for an overlapping pair.
  void correct_overlap(Index i, const Event<B>& event, RunCounters& counters) {
    const Index j = event.partner.other;
    const Vector d = meet(i, event);
    Motion<dimension> motion1 = state_.particles[i].motion(),
                      motion2 = state_.particles[j].motion();
    separate(motion1, state_.type(i).inertia, motion2, state_.type(j).inertia, d);
    state_.set_motion(i, motion1);
    state_.set_motion(j, motion2);
    ++counters.correction_moves;
  }

  /// Applies an instantaneous collision. Returns the approach speed of the surfaces.
  double impact(Index i, Index j, const Vector& d, const Vector& n, double restitution,
                RunCounters& counters) {
    Motion<dimension> motion1 = state_.particles[i].motion(),
                      motion2 = state_.particles[j].motion();
    const Impact result = i == j || !State::is_round
                              ? collide_shaped(i, j, motion1, motion2, n, restitution)
                              : collide_round(i, j, motion1, motion2, n, restitution);
    if (!std::isfinite(result.impulse)) report_self_overlap(i);
    state_.set_motion(i, motion1);
    if (i != j) state_.set_motion(j, motion2);
    ++state_.collisions;
    ++counters.collisions;
    counters.virial += result.impulse * n.dot(d);
    counters.dissipated += 0.5 * result.impulse * result.speed * (1 - restitution);
    return result.speed;
  }

 private:
  // Brings both to the present. Returns their separation.
  Vector meet(Index i, const Event<B>& event) {
    state_.advance_to_now(i);
    state_.advance_to_now(event.partner.other);
    return state_.separation(i, event.partner);
  }

  // The normal passes through both centres: rotation does not matter.
  Impact collide_round(Index i, Index j, Motion<dimension>& motion1, Motion<dimension>& motion2,
                       const Vector& n, double restitution) const {
    const double inverse_mass1 = state_.type(i).inertia.inverse_mass,
                 inverse_mass2 = state_.type(j).inertia.inverse_mass;
    const double growth = state_.size_now().growth_rate *
                          (state_.shape(i).circumradius() + state_.shape(j).circumradius());
    const double speed = (motion1.velocity - motion2.velocity).dot(n) + growth;
    // n has norm 1 to rounding, with a systematic error for equal disks: with n² here energy is still conserved.
    const double impulse =
        (1 + restitution) * speed / ((inverse_mass1 + inverse_mass2) * n.squaredNorm());
    motion1.velocity -= impulse * inverse_mass1 * n;
    motion2.velocity += impulse * inverse_mass2 * n;
    return {speed, impulse};
  }

  Impact collide_shaped(Index i, Index j, Motion<dimension>& motion1, Motion<dimension>& motion2,
                        const Vector& n, double restitution) const {
    const CommonSize size = state_.size_now();
    const auto arm = [&](Index k, const Vector& outward) {
      return surface_point(scaled(state_.shape(k), size.size), state_.particles[k].pose(), outward);
    };
    const Vector arm1 = arm(i, n), arm2 = arm(j, -n);
    const double growth = size.growth_rate / size.size * (arm1 - arm2).dot(n);
    const ContactGeometry<dimension> contact{n, cross(arm1, n), cross(arm2, n), growth};
    return i == j ? collide_with_own_image(motion1, state_.inertia_now(i), contact, restitution)
                  : collide(motion1, state_.inertia_now(i), motion2, state_.inertia_now(j), contact,
                            restitution);
  }

  [[noreturn]] void report_self_overlap(Index i) const {
    throw InvariantError(
        "particle " + std::to_string(state_.external_id[i]) + " grew into its own image at time " +
        std::to_string(state_.base + state_.now) + ": the box is too short for it");
  }

  State& state_;
  const EngineOptions& options_;
  InelasticCollapse<B> collapse_{state_};
};

}  // namespace vitrel
