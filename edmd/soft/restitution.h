#pragma once

#include "edmd/soft/contact_force.h"

/// @file
/// The restitution matrix: the effect of a collision of finite duration on two soft spheres.
///
/// While in contact, the pair moves in a plane about its centre of mass; r is the distance of the centres and φ the
/// angle of their line. With the scales X and T of the force (contact_force.h), and with tildes omitted,
///
///     φ' = c_φ/r²,   r'' = c_φ²/r³ + F(l − r, −r'),   φ(0) = 0, r(0) = l, r'(0) = −1,
///     c_φ = T L/(X² m_eff) = l (tangential speed/normal speed),   L the angular momentum.
///
/// The contact ends at the first τ at which the spheres separate, r' > 0, and the force vanishes. With damping this
/// happens before r = l, since from there on the force between separating spheres would attract: E(l − r) = c_dis r',
/// for both forces l − r = c_dis r'. F falls while r' > 0 and F > 0, so there is only one such time.
///
///     ε_r = r(τ)/l,   ε_φ = φ(τ),   ε_t = τ,   ε_ṙ = r'(τ)/r'(0) < 0
///
/// and φ'(τ)/φ'(0) = 1/ε_r². Elastic contacts (c_dis = 0) have ε_r = 1 and ε_ṙ = −1 exactly. The model allows particles
/// softer than l ≈ 1 to pass through each other. A head-on collision is the limit c_φ → 0: ε_φ is 0, or π if the
/// particles pass through each other.
///
/// Steps of the integration, in the variables s = √(l − r), ρ = r/l, φ, t and v:
///   1. dt = 2sρ dσ makes the motion smooth at first contact and, through ρ, where the centres nearly meet.
///   2. v = u + κE with u = −r', κ = 1/c_dis if c_dis ≥ 1, else 0: with strong damping E + c_dis u falls below the
///      rounding of u, so it is integrated directly.
///   3. Adaptive Runge–Kutta–Fehlberg steps of order 8, with a relative error of 10⁻¹⁴ each.
///   4. The end is a root in the length of the last step.
///
/// Accuracy: each coefficient has a relative error of 10⁻¹² (docs/validation.md), except near the jump of ε_φ from 0 to
/// π, which occurs in head-on impacts of soft particles, at l = 1 if they are elastic. Cost: about 20 µs. Sources:
/// mueller2013, and schwager2007 for the end of contact.
namespace vitrel {

/// An impact in the scales of its force.
struct ScaledImpact {
  double distance;          ///< l = (R₁ + R₂)/X > 0
  double angular_momentum;  ///< c_φ ≥ 0
  double damping;           ///< c_dis ≥ 0
};

struct Restitution {
  double distance;  ///< ε_r, at most 1
  double angle;     ///< ε_φ ≥ 0, rad, in the sense of the orbital motion
  double duration;  ///< ε_t, in units of T
  double rate;      ///< ε_ṙ, −1 ≤ ε_ṙ < 0
};

/// `normal_speed` > 0 and `tangential_speed` ≥ 0 are the components of the relative velocity of the centres at first
/// contact, in m/s; `scales` are those at the normal speed.
inline ScaledImpact scaled_impact(const ContactScales& scales, const ContactPair& pair,
                                  double normal_speed, double tangential_speed) {
  const double distance = pair.distance / scales.length;
  return {distance, distance * tangential_speed / normal_speed, scales.damping};
}
template <ContactForce Force>
ScaledImpact scaled_impact(const Force& force, const ContactPair& pair, double normal_speed,
                           double tangential_speed) {
  return scaled_impact(force.scales(normal_speed, pair), pair, normal_speed, tangential_speed);
}

/// Integrates the contact as described above. The result depends on the form of the force only, not on the material.
/// Throws InvariantError if the contact does not end (non-finite input).
template <ContactForce Force>
Restitution integrate_contact(const ScaledImpact& impact);

/// The form of a force, without its material and scales.
struct ForceForm {
  std::string_view name;
  double length_exponent, damping_exponent;
  Restitution (*integrate)(const ScaledImpact&);
  double (*elastic_inverse)(double);
};

template <ContactForce Force>
ForceForm form_of() {
  return {Force::name, Force::length_exponent, Force::damping_exponent, &integrate_contact<Force>,
          &Force::elastic_inverse};
}

}  // namespace vitrel
