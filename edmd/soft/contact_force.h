#pragma once

#include <concepts>
#include <string_view>

/// @file
/// Forces between two soft, frictionless spheres (disks) in contact, and their natural scales.
///
/// A force is a value type that holds the parameters of a material in SI units and provides the functions of
/// `ContactForce`. Two materials touch like two bodies in series: both feel the force, and each takes its share of the
/// compression, to first order in the damping (`mixed(one, other)` of each force). To add a force, write such a type in
/// its own header, and a source file with the explicit instantiations, like linear_dashpot.h and linear_dashpot.cpp.
///
/// ξ = l − r > 0 is the compression, where l = R₁ + R₂ and r is the distance of the centres; ξ̇ > 0 while the pair
/// approaches. The force chooses a length X and a time T such that dξ̃/dt̃ = 1 at first contact (X/T is the normal
/// speed). With ξ̃ = ξ/X and t̃ = t/T, every force must have the form
///
///     F_n T²/(m_eff X) = h(ξ̃) (E(ξ̃) + c_dis dξ̃/dt̃),   E(0) = 0, E increasing, h > 0 for ξ̃ > 0,
///
/// without any other parameter. h and E are functions of s = √ξ̃, in which Hertz's law is also a polynomial, so the
/// motion is smooth in s at first contact (restitution.h). They must also be finite for s < 0, since a trial step may
/// pass the end of the contact.
namespace vitrel {

/// The properties of a pair of spheres or disks on which the force depends. SI units.
struct ContactPair {
  double distance;  ///< l = R₁ + R₂, m
  double mass;      ///< m_eff = m₁m₂/(m₁ + m₂), kg
  double radius;    ///< R_eff = R₁R₂/(R₁ + R₂), m
};

constexpr ContactPair contact_pair(double radius1, double mass1, double radius2, double mass2) {
  return {radius1 + radius2, mass1 * mass2 / (mass1 + mass2),
          radius1 * radius2 / (radius1 + radius2)};
}

struct ContactScales {
  double time;     ///< T, s
  double length;   ///< X, m
  double damping;  ///< c_dis, dimensionless; 0: elastic
};

/// A force provides the following. `force(ξ, ξ̇, pair)` is F_n in N for ξ ≥ 0, positive if repulsive. The formula can
/// become negative, but the contact ends before that (restitution.h). `scales(speed, pair)` returns the scales for a
/// normal speed > 0 at first contact, in m/s. `profile(s)`, `elastic(s)` and `elastic_slope(s)` are h, E and dE/ds as
/// functions of s = √ξ̃; `elastic_inverse(E)` is the s ≥ 0 with this E. Finally, l/X ∝ speed^(−2p) and
/// c_dis ∝ (l/X)^(−q) with p = `length_exponent` and q = `damping_exponent`.
template <class Force>
concept ContactForce = requires(const Force& material, const ContactPair& pair, double x) {
  { Force::name } -> std::convertible_to<std::string_view>;
  { Force::length_exponent } -> std::convertible_to<double>;
  { Force::damping_exponent } -> std::convertible_to<double>;
  { material.force(x, x, pair) } -> std::same_as<double>;
  { material.scales(x, pair) } -> std::same_as<ContactScales>;
  { Force::profile(x) } -> std::same_as<double>;
  { Force::elastic(x) } -> std::same_as<double>;
  { Force::elastic_slope(x) } -> std::same_as<double>;
  { Force::elastic_inverse(x) } -> std::same_as<double>;
};

}  // namespace vitrel
