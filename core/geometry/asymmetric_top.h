#pragma once

#include <array>

#include "core/geometry/ellipsoid.h"

namespace vitrel {

/// The free rotation of a rigid body with three different principal moments of inertia, in closed form: Euler's
/// equations, solved by Jacobi's elliptic functions, and the attitude by theta functions.
///
/// The axes are numbered so that I₂ is the middle moment and axis 3 the one about which the body circulates: that of
/// the largest moment if L² ≥ 2EI₂, otherwise that of the smallest. With s = sign(I₃ − I₁), Δ_jk = |I_j − I_k| and the
/// phase u = u₀ + p t,
///
///     ω₁ = A cn u,  ω₂ = s sign(D) B sn u,  ω₃ = D dn u
///     A² = ω₁² + ω₂² I₂Δ₃₂/(I₁Δ₃₁),  B² = A² I₁Δ₃₁/(I₂Δ₃₂),  D² = ω₃² + ω₂² I₂Δ₂₁/(I₃Δ₃₁)
///     p = |D| √(Δ₃₂Δ₃₁/(I₁I₂)),  m = I₂Δ₂₁B²/(I₃Δ₃₁D²),  1 − m = (I₃Δ₃₂ω₃² − I₁Δ₂₁ω₁²)/(I₃Δ₃₂D²),
///
/// sums of terms of one sign, except for 1 − m, which vanishes on the separatrix. In the frame whose third axis is L,
/// and in which axis 3 of the body does not precess, the body is known from L in its own axes alone. That frame rotates
/// about L by
///
///     dψ/du = C + s d/du arg ϑ₁(π(u − iη)/2K),  sc(η | 1 − m) = ν^(−1/2),  ν = I₃Δ₂₁/(I₁Δ₃₂),
///
/// with C = L/(I₂p) − s d/dη ln ϑ₂(iπη/2K). (The value L/(I₁p) at u = 0 gives C, too, but as the difference of numbers
/// that are larger by up to I₂/I₁.) The theta functions are series in the nome q = exp(−πK'/K) for m ≤ ½ and,
/// by Jacobi's imaginary transformation, in the complementary nome exp(−πK/K') for m > ½. Both are at most e^(−π), so
/// that four terms suffice, on the separatrix as well as far from it.
///
/// Errors: some units in the last place of the initial state, times their effect on the phase, which grows in
/// proportion to time. |L| and E are conserved to rounding at any time.
///
/// Sources: jacobi1850; vanzon2007 (attitude by theta functions); carlson1995 (elliptic integrals).
class AsymmetricTop {
 public:
  /// At rest.
  AsymmetricTop() = default;

  /// A homogeneous ellipsoid. Orientation and angular velocity are those at time 0, in space. A body whose
  /// modelled moments are equal (ellipsoid.h) or that rotates about a principal axis rotates uniformly.
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

  /// max |dω/dt| ≤ f Ω², where f = max |I_j − I_k|/(I_i √3).
  static double max_acceleration_factor(const Ellipsoid& shape);

 private:
  static constexpr int terms = 4;
  using Series = std::array<double, terms>;

  /// The functions of u that an instant needs, for |u| ≤ K.
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
  Vec3 angular_velocity_ = Vec3::Zero();  ///< of uniform rotation

  std::array<int, 3> axis_{0, 1, 2};  ///< of the body, in the order above
  double handedness_ = 1;             ///< of that order: the sign of the third axis
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
