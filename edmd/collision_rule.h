#pragma once

#include "core/geometry/ellipse.h"
#include "core/geometry/ellipsoid.h"

/// @file
/// The collision of two smooth (frictionless) bodies with coefficient of restitution e.
///
///     k_i = arm_i = (x − r_i) × n,   u_n = (v₁ − v₂)·n + ω₁·k₁ − ω₂·k₂ + s   (> 0: approaching)
///     J = (1 + e) u_n/(1/m₁ + 1/m₂ + k₁·I₁⁻¹k₁ + k₂·I₂⁻¹k₂)
///     v₁ −= J n/m₁, v₂ += J n/m₂, ω₁ −= J I₁⁻¹k₁, ω₂ += J I₂⁻¹k₂
///
/// n is the unit contact normal from 1 to 2, x the contact point, and s the speed at which growth moves the
/// surfaces towards each other. In two dimensions k, ω and I are numbers. Momentum and angular momentum are
/// conserved exactly; the energy changes by J (s − u_n (1 − e)/2).
namespace vitrel {

/// The inertia of a body in the space frame. If an inverse moment of inertia is 0, the rotation is not modelled.
template <int Dim>
struct Inertia {
  double inverse_mass = 1;
  std::conditional_t<Dim == 2, double, Mat3> inverse_moment;
};

/// The same in the body frame, at size 1.
Inertia<2> inertia_of(const Ellipse& shape, double mass);
Inertia<3> inertia_of(const Ellipsoid& shape, double mass);
/// The space-frame inertia of a body of this size from its body-frame inertia.
Inertia<2> in_space(const Inertia<2>& own, const Pose2& pose, double size);
Inertia<3> in_space(const Inertia<3>& own, const Pose3& pose, double size);

template <int Dim>
struct ContactGeometry {
  Vec<Dim> normal;
  AngularVelocity<Dim> arm1, arm2;
  double growth = 0;  ///< s = γ₁ h₁(n) + γ₂ h₂(n)
};

/// Approach speed u_n of the surfaces.
template <int Dim>
double approach_speed(const Motion<Dim>& one, const Motion<Dim>& two,
                      const ContactGeometry<Dim>& contact);

struct Impact {
  double speed;    ///< u_n before
  double impulse;  ///< J
};

/// Changes the motions of two different bodies.
template <int Dim>
Impact collide(Motion<Dim>& one, const Inertia<Dim>& inertia1, Motion<Dim>& two,
               const Inertia<Dim>& inertia2, const ContactGeometry<Dim>& contact,
               double restitution);

/// The collision of a body with its own periodic image: both sides act on the same body, its velocity does not change,
/// and u_n = ω·k + s with k = k₁ − k₂; ω −= J I⁻¹k.
Impact collide_with_own_image(Motion2& motion, const Inertia<2>& inertia,
                              const ContactGeometry<2>& contact, double restitution);
Impact collide_with_own_image(Motion3& motion, const Inertia<3>& inertia,
                              const ContactGeometry<3>& contact, double restitution);

}  // namespace vitrel
