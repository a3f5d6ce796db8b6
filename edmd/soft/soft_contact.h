#pragma once

#include <cstdint>
#include <utility>

#include "core/elementary.h"
#include "core/geometry/pose.h"
#include "edmd/engine.h"
#include "edmd/soft/restitution.h"

/// @file
/// Collisions of soft spheres and disks in event-driven dynamics.
///
/// A contact takes a time τ, during which the line of centres rotates; the restitution matrix (restitution.h) maps the
/// state at its start to that at its end. A collision consists of three events:
///
///     E^φ  at first contact: the pair is rotated and rescaled about its centre of mass to its configuration at the
///          end of the contact, and both particles continue with the velocity of the centre of mass;
///     E^v  a time τ later, one for each particle: the particle takes its velocity after the contact.
///
/// From then on the trajectories are exact. There are two exceptions, both counted:
///
///     (a)  In its new position one of the pair would be closer than contact to a third particle (and closer than
///          before): the two collide as hard spheres, with the coefficient of restitution −ε_ṙ. In dense, strongly
///          damped systems such collisions would collapse (inelastic_collapse.h). If one of the two had another such
///          collision less than the duration τ of this contact before, the collision is therefore elastic, as in the
///          contact-time model, and counted.
///     (b)  A third particle hits one of the pair before τ has passed: its E^v is executed first.
///
/// Momentum is conserved to rounding, and so is the energy of elastic contacts. Angular momentum is conserved to
/// rounding except in (b), since the distance of the pair has changed when the partner is released later. It is
/// conserved there as well if both are released together.
///
/// While in contact, particles count with their velocities after the contact. The energy of an elastic gas, potential
/// energy included, therefore equals its kinetic energy. A contact contributes to the pressure as
///
///     ∫ (d·F + m_eff v²) dt − τ m_eff v'² = [m_eff d·v]₀^τ − τ m_eff v'²,
///
/// where d is the distance, v the relative velocity and v' the one after the contact; this is exact together with the
/// kinetic energy.
///
/// With damping, a pair leaves contact closer than the sum of its radii, and does not collide while it separates. If a
/// third particle makes it approach again before it is apart, a new contact begins at the current distance: no
/// collision is lost, and the surfaces still recede.
///
/// Validity: dilute systems. Source: mueller2013, section VI.
namespace vitrel {

/// The effect of contacts on the particles of a run.
class SoftContact {
 public:
  virtual ~SoftContact() = default;

  /// Returns the restitution, with the duration in simulated time, τ = ε_t T. The speeds are those of scaled_impact.
  /// Counts integrations.
  virtual Restitution collide(const ContactPair& pair, double normal_speed, double tangential_speed,
                              RunCounters& counters) = 0;
};

/// A force with its coefficients, which are tabulated or integrated (restitution_table.h). The coefficients map a
/// ScaledImpact to a Restitution and count their integrations.
template <ContactForce Force, class Coefficients>
class SoftContactOf final : public SoftContact {
 public:
  SoftContactOf(const Force& force, Coefficients coefficients)
      : force_(force), coefficients_(std::move(coefficients)) {}

  Restitution collide(const ContactPair& pair, double normal_speed, double tangential_speed,
                      RunCounters& counters) override {
    const ContactScales scales = force_.scales(normal_speed, pair);
    const std::uint64_t before = coefficients_.integrated();
    Restitution found = coefficients_(scaled_impact(scales, pair, normal_speed, tangential_speed));
    found.duration *= scales.time;
    counters.integrations += coefficients_.integrated() - before;
    return found;
  }

 private:
  Force force_;
  Coefficients coefficients_;
};

/// The motion of particle 2 relative to particle 1, r = r₂ − r₁.
template <int Dim>
struct RelativeMotion {
  Vec<Dim> position, velocity;
};

/// Returns the relative motion after a contact from that at first contact. With n = r/|r|, t the direction of the
/// tangential velocity, and u and w the speeds along −n and t:
///
///     r' = ε_r |r| n',   v' = −ε_ṙ u n' + (w/ε_r) t',
///     n' = cos ε_φ n + sin ε_φ t,   t' = cos ε_φ t − sin ε_φ n
template <int Dim>
RelativeMotion<Dim> after_contact(const RelativeMotion<Dim>& before,
                                  const Restitution& restitution) {
  const double distance = norm(before.position);
  const Vec<Dim> n = before.position / distance;
  const double approach = -dot(before.velocity, n);
  const Vec<Dim> across = before.velocity + approach * n;
  const double speed = norm(across);
  const Vec<Dim> t = speed > 0 ? Vec<Dim>(across / speed) : Vec<Dim>::Zero();
  const auto [c, s] = cosine_and_sine(restitution.angle);
  const Vec<Dim> turned = c * n + s * t;
  return {restitution.distance * distance * turned,
          -restitution.rate * approach * turned + speed / restitution.distance * (c * t - s * n)};
}

}  // namespace vitrel
