#pragma once

#include <array>

#include "core/geometry/ellipsoid.h"

namespace vitrel {

/// The free rotation of a rigid body with three different principal moments of inertia, in closed form. Jacobi's
/// elliptic functions solve Euler's equations, and theta functions give the attitude.
///
/// The axes are numbered so that I₂ is the middle moment and the body circulates about axis 3, which is the axis of the
/// largest moment if L² ≥ 2EI₂, otherwise that of the smallest. With s = sign(I₃ − I₁), Δ_jk = |I_j − I_k| and the
/// phase u = u₀ + p t,
///
///     ω₁ = A cn u,  ω₂ = s sign(D) B sn u,  ω₃ = D dn u
///     A² = ω₁² + ω₂² I₂Δ₃₂/(I₁Δ₃₁),  B² = A² I₁Δ₃₁/(I₂Δ₃₂),  D² = ω₃² + ω₂² I₂Δ₂₁/(I₃Δ₃₁)
///     p = |D| √(Δ₃₂Δ₃₁/(I₁I₂)),  m = I₂Δ₂₁B²/(I₃Δ₃₁D²),  1 − m = (I₃Δ₃₂ω₃² − I₁Δ₂₁ω₁²)/(I₃Δ₃₂D²),
///
/// All of these are sums of terms of one sign, except 1 − m, which vanishes on the separatrix. Take the frame whose
/// third axis is L and in which axis 3 of the body does not precess: in it, L in body coordinates alone determines the
/// attitude of the body. This frame rotates about L at the rate
///
///     dψ/du = C + s d/du arg ϑ₁(π(u − iη)/2K),  sc(η | 1 − m) = ν^(−1/2),  ν = I₃Δ₂₁/(I₁Δ₃₂),
///
/// with C = L/(I₂p) − s d/dη ln ϑ₂(iπη/2K). (The value L/(I₁p) at u = 0 gives C, too, but as the difference of numbers
/// that are larger by up to I₂/I₁.) The theta functions are series in the nome q = exp(−πK'/K) for m ≤ ½ and, by
/// Jacobi's imaginary transformation, in the complementary nome exp(−πK/K') for m > ½. Both nomes are at most e^(−π),
/// so four terms suffice, on the separatrix as well as far from it.
///
/// Rounding acts like a change of the initial state by a few units in the last place; its effect on the phase grows in
/// proportion to time. |L| and E are conserved to rounding at any time.
///
/// Sources: jacobi1850; vanzon2007 (attitude by theta functions); carlson1995 (elliptic integrals).
class AsymmetricTop {
 public:
  /// A body at rest.
  AsymmetricTop() = default;

  /// A homogeneous ellipsoid. Orientation and angular velocity are those at time 0, in space. A body rotates uniformly
  /// if its modelled moments are equal (ellipsoid.h) or if it rotates about a principal axis.
  AsymmetricTop(const Ellipsoid& shape, const Quaternion& orientation,
                const Vec3& angular_velocity);

  /// The axes of the body (columns), its angular velocity and that velocity's rate of change, all in space.
  struct State {
    Mat3 axes;
    Vec3 angular_velocity, angular_acceleration;
  };
  State at(double time) const;

  /// Ω, the maximum of |ω| over all times: Ω² = (2E(I₁ + I₃) − L²)/(I₁I₃), reached where ω₂ = 0.
  double max_speed() const { return max_speed_; }

  /// Returns f = max |I_j − I_k|/(I_i √3), for which |dω/dt| ≤ f Ω² at all times.
  static double max_acceleration_factor(const Ellipsoid& shape);

 private:
  static constexpr int terms = 4;
  using Series = std::array<double, terms>;

  /// The functions of u that determine the state at one time, for |u| ≤ K.
  struct Functions {
    double sn, cn;
    double theta_real, theta_imaginary;  ///< ϑ₁ of the precession, up to a positive factor
  };

  void rotate_uniformly(const Mat3& axes, const Vec3& angular_velocity);
  void set_direct_series(double complementary_quarter, double pole);
  void set_dual_series(double complementary_quarter, double pole);
  double start_phase(double sn, double cn) const;
  Functions functions(double u) const { return is_dual_ ? dual_functions(u) : direct_functions(u); }
  Functions direct_functions(double u) const;
  Functions dual_functions(double u) const;

  bool is_uniform_ = true;
  double max_speed_ = 0;
  /// At time 0: the axes of the body if it rotates uniformly, otherwise the precessing frame at ψ = 0.
  Mat3 start_ = Mat3::Identity();
  Vec3 angular_velocity_ = Vec3::Zero();  ///< of a body that rotates uniformly

  std::array<int, 3> axis_{0, 1, 2};  ///< indices of the body's axes, in the order above
  double handedness_ = 1;             ///< sign of the third axis that makes the frame right-handed
  Vec3 moments_ = Vec3::Ones();
  Vec3 amplitudes_ = Vec3::Zero();  ///< A, B and D with their signs
  double side_ = 1;                 ///< s
  double one_minus_m_ = 1;
  double phase_rate_ = 0, phase0_ = 0;  ///< p, u₀
  double quarter_ = 0;                  ///< K
  double precession_rate_ = 0;          ///< C
  double half_period_turn_ = 0;         ///< ψ(u + 2K) − ψ(u)

  bool is_dual_ = false;
  double scale_ = 0;       ///< π/2K, or π/2K'
  double ratio_ = 1;       ///< from the ratio of the series to sn : cn
  Series nome_powers_{};   ///< (−1)ⁿ q^(n(n + 1))
  Series nome_squares_{};  ///< dual: q^(n²)
  /// nome_powers_ times sinh and cosh of (2n + 1)πη/2K, or (−1)ⁿ times sin and cos of (2n + 1)πη/2K'.
  Series sines_{}, cosines_{};
};

}  // namespace vitrel
