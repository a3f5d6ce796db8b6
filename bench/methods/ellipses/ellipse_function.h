#pragma once

#include "core/geometry/ellipse.h"

namespace vitrel::bench {

/// The ellipse function E(t, x) = (x − r(t))ᵀ Σ(t)⁻¹ (x − r(t)) − 1 of an ellipse in free flight, with exact first
/// and second derivatives in (t, x, y). It is negative inside and 0 on the boundary.
struct EllipseFunction {
  double value;
  Vec3 gradient;            ///< ∂/∂(t, x, y)
  Eigen::Matrix3d hessian;  ///< second derivatives in the order (t, x, y)
};
EllipseFunction ellipse_function(const Flight<Ellipse>& flight, double time, const Vec2& point);

}  // namespace vitrel::bench
