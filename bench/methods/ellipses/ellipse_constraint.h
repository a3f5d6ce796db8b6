#pragma once

#include "bench/methods/ellipses/ellipse_function.h"
#include "core/geometry/growing.h"

namespace vitrel::bench {

/// The ellipse function of a growing ellipse in free flight,
///     E(t, x) = q(t, x)/s(t)² − 1,   q = (x − r(t))ᵀ Σ(t)⁻¹ (x − r(t)),   s(t) = size(t),
/// with Σ of the shape at size 1. It is negative inside and 0 on the boundary. With the growth rate γ and the
/// direction e of t,
///     ∇E = ∇q/s² − 2γ q/s³ e,
///     ∇²E = ∇²q/s² − 2γ/s³ (∇q eᵀ + e ∇qᵀ) + 6γ² q/s⁴ e eᵀ.
class EllipseConstraint {
 public:
  explicit EllipseConstraint(const Flight<GrowingEllipse>& flight);

  double value(double time, const Vec2& point) const;
  /// Value and gradient in (t, x, y), without the cost of the second derivatives.
  double value(double time, const Vec2& point, Vec3& gradient) const;
  EllipseFunction with_hessian(double time, const Vec2& point) const;

 private:
  double size_at(double time) const;

  Flight<Ellipse> flight_;  ///< at size 1
  double size_, growth_rate_;
};

}  // namespace vitrel::bench
