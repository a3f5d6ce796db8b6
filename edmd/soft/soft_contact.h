#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

#include "core/geometry/pose.h"
#include "edmd/engine.h"
#include "edmd/soft/restitution.h"

/// Collisions of soft spheres and disks in event-driven dynamics.
///
/// A contact takes a time τ, in which the line of centres turns; the matrix of restitution
/// (restitution.h) gives the state at its end from that at its beginning. A collision is three events:
///   E^φ  at first contact: the pair is turned and rescaled about its centre of mass, as it will be at
///        the end, and both go on with the velocity of the centre of mass;
///   E^v  a time τ later, one for each: it takes its velocity of after the contact.
/// From then on the trajectories are those of the force. Two exceptions, both counted:
///   (a)  at its new place one of the pair would be closer than contact to a third particle (and closer
///        than it was): the two collide as hard spheres, with the coefficient of restitution −ε_ṙ;
///   (b)  a third particle comes to one of the pair before τ has passed: its E^v is executed just before.
///
/// Conserved, to rounding: momentum; energy, if elastic; angular momentum, except in (b), as the distance
/// of the pair is another one when the partner is released too. If both are released together nothing
/// is lost.
///
/// While in contact, particles count with the velocities they will be released with. So the energy of an
/// elastic gas, potential energy included, is its kinetic energy. For the pressure a contact counts as
///     ∫ (d·F + m_eff v²) dt − τ m_eff v'² = [m_eff d·v]₀^τ − τ m_eff v'²,
/// d the distance, v the relative velocity and v' that after the contact, which is exact together with
/// the kinetic energy counted so.
///
/// With damping a pair leaves contact closer than the sum of its radii. As long as it separates it
/// meets nothing. Should a third particle make it approach again before it is apart, this is a new
/// contact, which begins at the distance that the two have: none is lost, and the surfaces still recede.
///
/// Validity: dilute systems. Source: mueller2013, section VI.
namespace vitrel {

/// What contacts do to the particles of a run.
class SoftContact {
 public:
  virtual ~SoftContact() = default;

  /// Speeds as in scaled_impact; the duration is in units of time, τ = ε_t T. Counts integrations.
  virtual Restitution collide(const ContactPair& pair, double normal_speed, double tangential_speed,
                              RunCounters& counters) = 0;
};

/// By a force and its coefficients, tabulated or integrated (restitution_table.h): they give the Restitution of
/// a ScaledImpact, and how many they have integrated.
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

/// Of particle 2 as seen from particle 1, r = r₂ − r₁.
template <int Dim>
struct RelativeMotion {
  Vec<Dim> position, velocity;
};

/// From first contact to its end. With n = r/|r|, t the direction of the velocity across it, and u and
/// w the speeds along −n and t:
///     r' = ε_r |r| n',   v' = −ε_ṙ u n' + (w/ε_r) t',
///     n' = cos ε_φ n + sin ε_φ t,   t' = cos ε_φ t − sin ε_φ n
template <int Dim>
RelativeMotion<Dim> after_contact(const RelativeMotion<Dim>& before,
                                  const Restitution& restitution) {
  const double distance = before.position.norm();
  const Vec<Dim> n = before.position / distance;
  const double approach = -before.velocity.dot(n);
  const Vec<Dim> across = before.velocity + approach * n;
  const double speed = across.norm();
  const Vec<Dim> t = speed > 0 ? Vec<Dim>(across / speed) : Vec<Dim>::Zero();
  const double c = std::cos(restitution.angle), s = std::sin(restitution.angle);
  const Vec<Dim> turned = c * n + s * t;
  return {restitution.distance * distance * turned,
          -restitution.rate * approach * turned + speed / restitution.distance * (c * t - s * n)};
}

}  // namespace vitrel
