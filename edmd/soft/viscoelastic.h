#pragma once

#include <cmath>

#include "core/elementary.h"
#include "edmd/soft/contact_force.h"

namespace vitrel {

/// Viscoelastic spheres: Hertz's elastic force with the dissipation of quasistatic motion,
///
///     F_n = ρ ξ^(3/2) + (3/2) A ρ ξ̇ ξ^(1/2),   ρ = 2 Y √R_eff/(3 (1 − ν²))
///     T = κ^(−2/5) speed^(−1/5),  X = κ^(−2/5) speed^(4/5),  κ = ρ/m_eff
///     F̃ = ξ̃^(1/2) (ξ̃ + c_dis dξ̃/dt̃),  c_dis = 3A/(2T)
///
/// Disks are modelled as spheres. Validity: ξ well below R_eff. The source covers Y from 0.01 to 100 GPa, ν from 0.2 to
/// 0.5 and A from 10⁻⁶ to 1 s. Sources: mueller2013, section V.2; brilliantov1996.
struct Viscoelastic {
  static constexpr std::string_view name = "viscoelastic";
  static constexpr double length_exponent = 0.4;
  static constexpr double damping_exponent = 0.25;

  double youngs_modulus;        ///< Y > 0, N/m²
  double poissons_ratio;        ///< ν, −1 < ν ≤ 1/2
  double dissipative_time = 0;  ///< A ≥ 0, s

  /// Returns ρ in N/m^(3/2).
  double stiffness(const ContactPair& pair) const {
    return 2 * youngs_modulus * std::sqrt(pair.radius) /
           (3 * (1 - poissons_ratio * poissons_ratio));
  }
  double force(double compression, double rate, const ContactPair& pair) const {
    return stiffness(pair) * std::sqrt(compression) * (compression + 1.5 * dissipative_time * rate);
  }
  ContactScales scales(double speed, const ContactPair& pair) const {
    const double time =
        exponential(-0.4 * logarithm(stiffness(pair) / pair.mass) - 0.2 * logarithm(speed));
    return {time, speed * time, 1.5 * dissipative_time / time};
  }

  static double profile(double s) { return s; }
  static double elastic(double s) { return s * s; }
  static double elastic_slope(double s) { return 2 * s; }
  static double elastic_inverse(double elastic) { return std::sqrt(elastic); }
};

/// The pair has the effective modulus E with 1/E = 1/E₁ + 1/E₂ and E_i = Y_i/(1 − ν_i²), so A = E (A₁/E₁ + A₂/E₂), and
/// ρ = 4/3 E √R_eff is that of Y = 2 E and ν = 0.
inline Viscoelastic mixed(const Viscoelastic& one, const Viscoelastic& other) {
  const auto plane_modulus = [](const Viscoelastic& v) {
    return v.youngs_modulus / (1 - v.poissons_ratio * v.poissons_ratio);
  };
  const double e1 = plane_modulus(one), e2 = plane_modulus(other);
  const double share1 = e2 / (e1 + e2), share2 = e1 / (e1 + e2);
  return {2 * e1 * share1, 0, share1 * one.dissipative_time + share2 * other.dissipative_time};
}

static_assert(ContactForce<Viscoelastic>);

}  // namespace vitrel
