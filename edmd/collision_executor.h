#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "edmd/collision_rule.h"
#include "edmd/engine.h"
#include "edmd/event.h"
#include "edmd/inelastic_collapse.h"
#include "edmd/time_text.h"

namespace vitrel {

/// Executes collisions of hard particles, which give both particles new velocities.
template <Body B>
class CollisionExecutor {
 public:
  using State = SimulationState<B>;
  using Index = typename State::Index;
  using Vector = typename State::Vector;
  static constexpr int dimension = State::dimension;

  CollisionExecutor(State& state, const EngineOptions& options)
      : state_(state),
        laws_(options.laws),
        tc_(options.contact_duration),
        has_contact_times_(tc_ > 0 || are_soft(options)),
        collapses_(laws_.are_inelastic() && !(tc_ > 0)) {}

  void begin_block() {
    collapse_.begin_block();
    last_collision_.assign(has_contact_times_ ? state_.size() : 0, -State::never);
  }
  /// Sets the times back by `elapsed`, as SimulationState::reset_clocks does.
  void reset_clocks(double elapsed) {
    for (double& time : last_collision_) time -= elapsed;
  }

  /// Executes the collision of particle i with the partner of its event. Both must then be predicted again.
  void collide_pair(Index i, const Event<B>& event, RunCounters& counters) {
    const Index j = event.partner.other;
    const double since = state_.now - std::max(state_.last_change(i), state_.last_change(j));
    const Vector d = meet(i, event);
    const Vector normal = event.normal_along(d);
    const double speed = collide(i, j, d, normal, counters);
    if (collapses_) collapse_.detect(i, j, speed * since);
    if constexpr (!State::is_round) state_.neighborhoods->store_axis(i, event.partner, normal);
  }

  /// Executes the correction move for an overlapping pair.
  void correct_overlap(Index i, const Event<B>& event, RunCounters& counters) {
    const Index j = event.partner.other;
    const Vector d = meet(i, event);
    Motion<dimension> motion1 = state_.particles[i].motion(),
                      motion2 = state_.particles[j].motion();
    const Vector before = motion1.velocity - motion2.velocity;
    const Vector velocity1 = motion1.velocity;
    separate(motion1, state_.type(i).inertia, motion2, state_.type(j).inertia, d);
    const Vector momentum = (velocity1 - motion1.velocity) / state_.type(i).inertia.inverse_mass;
    record_transfer(momentum, d, before, motion1, motion2, counters);
    state_.set_motion(i, motion1);
    state_.set_motion(j, motion2);
    ++counters.correction_moves;
  }

  /// Collides a soft pair that cannot rotate (soft/soft_contact.h) like hard particles with this restitution. The
  /// contact-time model applies, with t_c the duration of the contact.
  void collide_soft_pair(Index i, Index j, const Vector& d, const Vector& n, double restitution,
                         double contact_duration, RunCounters& counters) {
    if (flight_is_short(i, j, contact_duration))
      collide_again(i, j, d, n, speed_of_approach(i, j, n), restitution, counters);
    else
      impact(i, j, d, n, restitution, counters);
  }

 private:
  /// Applies an instantaneous smooth collision.
  Impact impact(Index i, Index j, const Vector& d, const Vector& n, double restitution,
                RunCounters& counters) {
    Motion<dimension> motion1 = state_.particles[i].motion(),
                      motion2 = state_.particles[j].motion();
    const Vector before = motion1.velocity - motion2.velocity;
    const Impact result = i == j || !State::is_round
                              ? collide_shaped(i, j, motion1, motion2, n, restitution)
                              : collide_round(i, j, motion1, motion2, n, restitution);
    if (!std::isfinite(result.impulse)) report_self_overlap(i);
    state_.set_motion(i, motion1);
    if (i != j) state_.set_motion(j, motion2);
    ++state_.collisions;
    ++counters.collisions;
    counters.virial += result.impulse * dot(n, d);
    record_transfer(result.impulse * n, d, before, motion1, motion2, counters);
    const double lost = 0.5 * result.impulse * result.speed * (1 - restitution);
    if (restitution > 1)
      counters.added -= lost;
    else
      counters.dissipated += lost;
    return result;
  }

  /// Executes a collision by the law of the pair. Returns the approach speed of the surfaces, or 0 if the contact-time
  /// model has made the collision elastic.
  double collide(Index i, Index j, const Vector& d, const Vector& n, RunCounters& counters) {
    const ContactLaw& law = state_.of_pair(laws_, i, j);
    const bool is_short = tc_ > 0 && flight_is_short(i, j, tc_);
    const bool is_rough = law.is_rough() && i != j;
    if (!is_rough && law.restitution.is_elastic()) return impact(i, j, d, n, 1, counters).speed;
    const double speed = speed_of_approach(i, j, n);
    if (is_short || (tc_ > 0 && cannot_come_apart(law, i, j, speed))) {
      collide_again(i, j, d, n, speed, law.restitution(speed), counters);
      return 0;
    }
    const double restitution = restitution_of(law, i, j, speed);
    if (is_rough)
      rub(i, j, d, n, law, restitution, counters);
    else
      impact(i, j, d, n, restitution, counters);
    return speed;
  }

  /// Records the momentum that the first particle hands to the second; `before` is their relative velocity before that.
  void record_transfer(const Vector& momentum, const Vector& d, const Vector& before,
                       const Motion<dimension>& motion1, const Motion<dimension>& motion2,
                       RunCounters& counters) {
    const Vector mean = 0.5 * (before + motion1.velocity - motion2.velocity);
    state_.flux.transfer(state_.now, momentum, d, mean, counters.helfand_moment);
  }

  bool cannot_come_apart(const ContactLaw& law, Index i, Index j, double speed) const {
    return !law.restitution.is_elastic() && speed < separation_speed(i, j);
  }

  double restitution_of(const ContactLaw& law, Index i, Index j, double speed) const {
    if (law.restitution.is_elastic()) return 1;
    return std::max(law.restitution(speed), std::min(1., separation_speed(i, j) / speed));
  }

  /// Returns the speed below which separating surfaces would touch again at once by rounding. With the contact-time
  /// model they must also get clear of the contact gap, although they may rotate towards each other with an
  /// acceleration of the order of v²/R.
  double separation_speed(Index i, Index j) const {
    constexpr double of_fastest = 1e-13;  // far above the rounding of velocities
    constexpr double contact_gaps = 1e4;
    if (State::is_round || !(tc_ > 0)) return of_fastest * state_.fastest;
    const double size = std::min(state_.shape(i).inradius(), state_.shape(j).inradius());
    return std::sqrt(contact_gaps * state_.contact_gap / size) * state_.fastest;
  }

  /// Records a collision of the pair. Returns whether one of the two had another collision less than `contact_duration`
  /// before.
  bool flight_is_short(Index i, Index j, double contact_duration) {
    const double since = state_.now - std::max(last_collision_[i], last_collision_[j]);
    last_collision_[i] = last_collision_[j] = state_.now;
    return since < contact_duration;
  }

  /// Applies the contact-time model (inelastic_collapse.h): an elastic, smooth collision replaces one with this
  /// restitution. Surfaces that would stay together gain the separation speed, and the energy that this adds is
  /// counted.
  void collide_again(Index i, Index j, const Vector& d, const Vector& n, double speed,
                     double restitution, RunCounters& counters) {
    const double elastic = std::max(1., separation_speed(i, j) / speed);
    const Impact result = impact(i, j, d, n, elastic, counters);
    const double along = result.impulse * speed / (2 * (1 + elastic));
    ++counters.short_flights;
    counters.spared += (1 - restitution * restitution) * along;
  }

  /// Executes a rough collision.
  void rub(Index i, Index j, const Vector& d, const Vector& n, const ContactLaw& law,
           double restitution, RunCounters& counters) {
    Motion<dimension> motion1 = state_.full_motion(i), motion2 = state_.full_motion(j);
    const Vector before = motion1.velocity - motion2.velocity;
    const RoughContact<dimension> contact{n, surface_from(i, n), surface_from(j, -n)};
    const RoughImpact<dimension> result =
        collide_rough(motion1, state_.full_inertia_now(i), motion2, state_.full_inertia_now(j),
                      contact, restitution, law);
    state_.set_full_motion(i, motion1);
    state_.set_full_motion(j, motion2);
    ++state_.collisions;
    ++counters.collisions;
    counters.virial -= dot(result.impulse, d);
    record_transfer(-result.impulse, d, before, motion1, motion2, counters);
    counters.dissipated += result.dissipated;
  }

  double speed_of_approach(Index i, Index j, const Vector& n) const {
    const Motion<dimension> motion1 = state_.particles[i].motion(),
                            motion2 = state_.particles[j].motion();
    if (i != j && State::is_round) return dot(motion1.velocity - motion2.velocity, n);
    return approach_speed(motion1, motion2, contact_geometry(i, j, n));
  }

  /// Returns the vector from the centre of particle i to the point of its surface with this outward normal.
  Vector surface_from(Index i, const Vector& outward) const {
    return surface_point(scaled(state_.shape(i), state_.size_now().size),
                         state_.particles[i].pose(), outward);
  }

  // Advances both particles to the present. Returns their separation.
  Vector meet(Index i, const Event<B>& event) {
    state_.advance_to_now(i);
    state_.advance_to_now(event.partner.other);
    return state_.separation(i, event.partner);
  }

  // The normal passes through both centres, so rotation does not matter.
  Impact collide_round(Index i, Index j, Motion<dimension>& motion1, Motion<dimension>& motion2,
                       const Vector& n, double restitution) const {
    const double inverse_mass1 = state_.type(i).inertia.inverse_mass,
                 inverse_mass2 = state_.type(j).inertia.inverse_mass;
    const double growth = state_.size_now().growth_rate *
                          (state_.shape(i).circumradius() + state_.shape(j).circumradius());
    const double speed = dot(motion1.velocity - motion2.velocity, n) + growth;
    // n has norm 1 only up to rounding, with a systematic error for equal disks; the factor n² still conserves energy.
    const double impulse =
        (1 + restitution) * speed / ((inverse_mass1 + inverse_mass2) * squared_norm(n));
    motion1.velocity -= impulse * inverse_mass1 * n;
    motion2.velocity += impulse * inverse_mass2 * n;
    return {speed, impulse};
  }

  Impact collide_shaped(Index i, Index j, Motion<dimension>& motion1, Motion<dimension>& motion2,
                        const Vector& n, double restitution) const {
    const ContactGeometry<dimension> contact = contact_geometry(i, j, n);
    return i == j ? collide_with_own_image(motion1, state_.inertia_now(i), contact, restitution)
                  : vitrel::collide(motion1, state_.inertia_now(i), motion2, state_.inertia_now(j),
                                    contact, restitution);
  }

  ContactGeometry<dimension> contact_geometry(Index i, Index j, const Vector& n) const {
    const CommonSize size = state_.size_now();
    const Vector arm1 = surface_from(i, n), arm2 = surface_from(j, -n);
    const double growth = size.growth_rate / size.size * dot(arm1 - arm2, n);
    return {n, cross(arm1, n), cross(arm2, n), growth};
  }

  [[noreturn]] void report_self_overlap(Index i) const {
    throw InvariantError(std::string("particle ") + std::to_string(state_.external_id[i]) +
                         " grew into its own image at " + time_text(state_.base + state_.now) +
                         ": the box is too short for it");
  }

  State& state_;
  const ContactLaws& laws_;
  const double tc_;
  const bool has_contact_times_;
  const bool collapses_;  ///< whether inelastic collapse is possible, and stops the run
  std::vector<double> last_collision_;  ///< of each particle, for the contact-time model
  InelasticCollapse<B> collapse_{state_};
};

}  // namespace vitrel
