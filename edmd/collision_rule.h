#pragma once

#include "core/geometry/particle_shape.h"
#include "edmd/contact_law.h"

/// @file
/// The collision of two bodies, which are either smooth (frictionless) with a coefficient of restitution e, or rough.
///
/// Smooth bodies:
///
///     k_i = arm_i = (x − r_i) × n,   u_n = (v₁ − v₂)·n + ω₁·k₁ − ω₂·k₂ + s   (> 0: approaching)
///     J = (1 + e) u_n/(1/m₁ + 1/m₂ + k₁·I₁⁻¹k₁ + k₂·I₂⁻¹k₂)
///     v₁ −= J n/m₁, v₂ += J n/m₂, ω₁ −= J I₁⁻¹k₁, ω₂ += J I₂⁻¹k₂
///
/// Here n is the unit contact normal from 1 to 2, x the contact point, and s the speed at which growth moves the
/// surfaces towards each other. In two dimensions k, ω and I are numbers. Momentum and angular momentum are conserved
/// exactly; the energy changes by J (s − u_n (1 − e)/2).
///
/// Rough bodies follow the law of chatterjee1998, which contains the smooth one as the case μ = 0. Let v be the
/// velocity of the surface of 1 relative to that of 2 at the contact point, P the impulse on 1, and K = M⁻¹ the matrix
/// by which P changes v; n, k_i and J are as above.
///
///     K = Σ_i (1/m_i + [ρ_i]ₓ I_i⁻¹ [ρ_i]ₓᵀ),  ρ_i from the centre of i to the contact point
///     P_I = −n (n·v)/(n·K n)    takes the normal speed away, without friction
///     P_II = −K⁻¹ v             takes all of v away
///     P = (1 + e) P_I + κ (P_II − P_I)
///
/// κ is 1 + β, lowered until |P_t| ≤ μ P_n. This is Coulomb's friction cone, which for μ = ∞ still excludes P_n < 0.
/// Let E_n = (n·v)²/(2 n·K n) and E_t = v·K⁻¹v/2 − E_n be the energies of v along and across the normal. P_I and
/// P_II − P_I are orthogonal with respect to K, so that
///     n·v' = −e n·v,   E' = e² E_n + (1 − κ)² E_t ≤ E_n + E_t.
///
/// Hence no impact creates energy, whatever the shapes. For disks and spheres this is the law of Walton and Braun
/// (walton1986). For other bodies the normal and the tangential motion couple.
///
/// The law uses the true moments of inertia and angular velocities, also for rotations that smooth collisions do not
/// change.
namespace vitrel {

/// The inertia of a body in the space frame. If an inverse moment of inertia is 0, the rotation is not modelled.
template <int Dim>
struct Inertia {
  double inverse_mass = 1;
  std::conditional_t<Dim == 2, double, Mat3> inverse_moment;
};

/// Returns the inertia in the body frame at size 1.
Inertia<2> inertia_of(const ParticleShape<2>& shape, double mass);
Inertia<3> inertia_of(const ParticleShape<3>& shape, double mass);
/// Returns the inertia in the body frame at size 1, with all true moments.
Inertia<2> full_inertia_of(const ParticleShape<2>& shape, double mass);
Inertia<3> full_inertia_of(const ParticleShape<3>& shape, double mass);
/// Returns the space-frame inertia of a body of this size from its body-frame inertia.
Inertia<2> in_space(const Inertia<2>& own, const Pose2& pose, double size);
Inertia<3> in_space(const Inertia<3>& own, const Pose3& pose, double size);

template <int Dim>
struct ContactGeometry {
  Vec<Dim> normal;
  AngularVelocity<Dim> arm1, arm2;
  double growth = 0;  ///< s = γ₁ h₁(n) + γ₂ h₂(n)
};

/// Returns the approach speed u_n of the surfaces.
template <int Dim>
double approach_speed(const Motion<Dim>& one, const Motion<Dim>& two,
                      const ContactGeometry<Dim>& contact);

struct Impact {
  double speed;    ///< u_n before the collision
  double impulse;  ///< J
};

/// Executes the collision of two different bodies, which changes their motions.
template <int Dim>
Impact collide(Motion<Dim>& one, const Inertia<Dim>& inertia1, Motion<Dim>& two,
               const Inertia<Dim>& inertia2, const ContactGeometry<Dim>& contact,
               double restitution);

/// Executes the collision of a body with its own periodic image: both sides act on the same body, so its velocity does
/// not change. With k = k₁ − k₂, u_n = ω·k + s and ω −= J I⁻¹k.
Impact collide_with_own_image(Motion2& motion, const Inertia<2>& inertia,
                              const ContactGeometry<2>& contact, double restitution);
Impact collide_with_own_image(Motion3& motion, const Inertia<3>& inertia,
                              const ContactGeometry<3>& contact, double restitution);

/// The place where two bodies touch.
template <int Dim>
struct RoughContact {
  Vec<Dim> normal;      ///< from 1 to 2
  Vec<Dim> arm1, arm2;  ///< from the centres to the contact point
};

template <int Dim>
struct RoughImpact {
  Vec<Dim> impulse;   ///< P, on 1
  double dissipated;  ///< energy lost, (1 − e²) E_n + (1 − (1 − κ)²) E_t
};

/// Executes the collision of two different rough bodies, neither of which grows. `restitution` is e at the approach
/// speed n·v, and `law` gives μ and β.
template <int Dim>
RoughImpact<Dim> collide_rough(Motion<Dim>& one, const Inertia<Dim>& inertia1, Motion<Dim>& two,
                               const Inertia<Dim>& inertia2, const RoughContact<Dim>& contact,
                               double restitution, const ContactLaw& law);

/// Applies the correction move to an overlapping pair (on_overlap = "correct"): it turns the relative velocity into the
/// line of centres so that the bodies separate, and keeps the angular velocities. It conserves momentum and energy, but
/// not angular momentum. `d` runs from centre 1 to centre 2.
template <int Dim>
void separate(Motion<Dim>& one, const Inertia<Dim>& inertia1, Motion<Dim>& two,
              const Inertia<Dim>& inertia2, const Vec<Dim>& d);

}  // namespace vitrel
