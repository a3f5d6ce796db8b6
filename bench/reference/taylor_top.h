#pragma once

#include <array>
#include <vector>

#include "core/geometry/ellipsoid.h"

namespace vitrel::bench {

/// The free rotation of a homogeneous ellipsoid by Taylor series of Euler's equations, in 80-bit arithmetic. It
/// shares no code with the closed form (core/geometry/asymmetric_top.h).
///
/// With ω along the axes of the body and q the quaternion of its attitude,
///
///     dωᵢ/dt = fᵢ ωⱼ ωₖ,   dq/dt = ½ q ω,   fᵢ = (Iⱼ − Iₖ)/Iᵢ = (aₖ² − aⱼ²)/(aⱼ² + aₖ²),
///
/// so every coefficient of the series follows from the previous ones. A step ends where the last two terms, relative
/// to |ω| and |q|, reach a sixteenth of the rounding. Within the step the series can be evaluated at any time.
class TaylorTop {
 public:
  using Real = long double;
  using Vector = Eigen::Matrix<Real, 3, 1>;
  using Matrix = Eigen::Matrix<Real, 3, 3>;

  /// Integrates from time 0 to `end`, which may be negative. `orientation` and `angular_velocity` are those at time
  /// 0, in space.
  TaylorTop(const Ellipsoid& shape, const Quaternion& orientation, const Vec3& angular_velocity,
            Real end);

  /// The axes of the body (columns) and its angular velocity, both in space.
  struct State {
    Matrix axes;
    Vector angular_velocity;
  };
  State at(Real time) const;

  /// An upper bound of |ω|: |ω| ≤ √(2E/I₁) ≤ L/I₁ with the smallest moment I₁, since 2E = Σ Iᵢωᵢ² ≥ I₁ω².
  Real speed_bound() const { return speed_bound_; }

  /// An estimate of the angle by which the body is off at `time`, in units of the relative error of its initial
  /// state:
  ///
  ///     Ω t min(e^(λt), max(L², 2EI₂)/|L² − 2EI₂|),   λ² = 2E/I₂ · (I₃ − I₂)(I₂ − I₁)/(I₁I₃),
  ///
  /// with the bound Ω above. Rotation about the axis of the middle moment is unstable at a rate of at most λ, and the
  /// period diverges as −ln|L² − 2EI₂| at the separatrix.
  Real sensitivity(Real time) const;

 private:
  static constexpr int order = 24;
  using Attitude = Eigen::Quaternion<Real>;

  /// The coefficients of the step that begins at `start`.
  struct Series {
    Real start;
    std::array<Vector, order + 1> omega;
    std::array<Attitude, order + 1> attitude;
  };
  struct BodyState {
    Attitude attitude;
    Vector omega;
  };
  Series expanded(Real start, const BodyState& state) const;
  static Real step(const Series& series);
  static BodyState evaluated(const Series& series, Real time);

  Vector factors_;
  Real direction_;  ///< the sign of the end
  std::vector<Series> series_;
  Real speed_bound_, instability_, distance_from_separatrix_;
};

}  // namespace vitrel::bench
