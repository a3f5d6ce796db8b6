#pragma once

#include "core/geometry/pose.h"

/// What an impact does to two bodies: smooth (frictionless) surfaces, coefficient of restitution e.
///
///     k_i = arm_i = (x − r_i) × n,   u_n = (v₁ − v₂)·n + ω₁ k₁ − ω₂ k₂ + s   (> 0: approaching)
///     J = (1 + e) u_n/(1/m₁ + 1/m₂ + k₁²/I₁ + k₂²/I₂)
///     v₁ −= J n/m₁, v₂ += J n/m₂, ω₁ −= J k₁/I₁, ω₂ += J k₂/I₂
///
/// n is the unit contact normal from 1 to 2, x the contact point, and s the speed at which growth
/// moves the surfaces towards each other. Momentum and angular momentum are conserved exactly; the
/// energy changes by J (s − u_n (1 − e)/2).
namespace vitrel {

/// The inertia of a body; an inverse moment of inertia 0 means that rotation is not modelled.
struct Inertia {
  double inverse_mass = 1;
  double inverse_moment = 0;
};

struct ContactGeometry {
  Vec2 normal;
  double arm1, arm2;
  double growth = 0;  ///< s = γ₁ h₁(n) + γ₂ h₂(n)
};

/// Approach speed u_n of the surfaces.
double approach_speed(const Motion2& one, const Motion2& two, const ContactGeometry& contact);

/// Changes the motions of two different bodies and returns the impulse J.
double collide(Motion2& one, const Inertia& inertia1, Motion2& two, const Inertia& inertia2,
               const ContactGeometry& contact, double restitution);

/// The impact of a body with its own periodic image: both sides act on the same body, its velocity
/// stays and u_n = ω (k₁ − k₂) + s; without growth ω becomes −e ω. Returns the impulse J.
double collide_with_own_image(Motion2& motion, const Inertia& inertia,
                              const ContactGeometry& contact, double restitution);

/// The correction move for a pair found overlapping (on_overlap = "correct"): the relative velocity
/// is laid along the line of centres so that the bodies separate; angular velocities stay. It
/// conserves momentum and energy, but not angular momentum. `d` runs from centre 1 to centre 2.
void separate(Motion2& one, const Inertia& inertia1, Motion2& two, const Inertia& inertia2,
              const Vec2& d);

}  // namespace vitrel
