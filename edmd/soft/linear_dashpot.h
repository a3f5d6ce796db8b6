#pragma once

#include <cmath>

#include "edmd/soft/contact_force.h"

namespace vitrel {

/// A spring and a dashpot, F_n = k ξ + γ ξ̇.
///
///     T = 1/ω,  X = speed/ω,  ω = √(k/m_eff),   F̃ = ξ̃ + c_dis dξ̃/dt̃,  c_dis = γ T/m_eff
///
/// In the limit of hard spheres the coefficient of restitution depends on c_dis only, not on the speed. The source
/// covers k from 10³ to 10⁶ N/m and γ from 0.01 to 1.25 kg/s. Source: mueller2013, section V.1.
struct LinearDashpot {
  static constexpr std::string_view name = "linear_dashpot";
  static constexpr double length_exponent = 0.5;
  static constexpr double damping_exponent = 0;

  double stiffness;    ///< k > 0, N/m
  double damping = 0;  ///< γ ≥ 0, kg/s

  double force(double compression, double rate, const ContactPair&) const {
    return stiffness * compression + damping * rate;
  }
  ContactScales scales(double speed, const ContactPair& pair) const {
    const double time = std::sqrt(pair.mass / stiffness);
    return {time, speed * time, damping * time / pair.mass};
  }

  static double profile(double) { return 1; }
  static double elastic(double s) { return s * s; }
  static double elastic_slope(double s) { return 2 * s; }
  static double elastic_inverse(double elastic) { return std::sqrt(elastic); }
};

/// The pair has k and γ with 2/k = 1/k₁ + 1/k₂ and 2 γ/k² = γ₁/k₁² + γ₂/k₂².
inline LinearDashpot mixed(const LinearDashpot& one, const LinearDashpot& other) {
  const double k1 = one.stiffness, k2 = other.stiffness;
  const double share1 = k2 / (k1 + k2), share2 = k1 / (k1 + k2);
  return {2 * k1 * share1, 2 * (share1 * share1 * one.damping + share2 * share2 * other.damping)};
}

static_assert(ContactForce<LinearDashpot>);

}  // namespace vitrel
