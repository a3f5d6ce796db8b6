#pragma once

#include <cmath>
#include <numbers>

#include "core/geometry/body.h"

namespace vitrel {

/// A hard ellipse with semi-axes a ≥ b > 0; the angle of its pose points along a.
struct Ellipse {
  static constexpr int dimension = 2;
  double a = 1;
  double b = 1;

  bool operator==(const Ellipse&) const = default;
  double circumradius() const { return a; }
  double inradius() const { return b; }
  Vec2 half_lengths() const { return {a, b}; }
  double volume() const { return std::numbers::pi * a * b; }
  double size() const { return std::sqrt(a * b); }
  double natural_mass() const { return a * b; }
  double max_support_rate() const { return a - b; }
  double aspect_ratio() const { return a / b; }
  bool is_round() const { return a == b; }
  bool fits_into(const Ellipse& other) const { return a <= other.a && b <= other.b; }
  /// The number of rotational degrees of freedom that smooth collisions change.
  int rotations() const { return is_round() ? 0 : 1; }
  /// a² − b², without cancellation.
  double aa_minus_bb() const { return (a - b) * (a + b); }
  /// The moment of inertia of the homogeneous ellipse divided by its mass, (a² + b²)/4.
  double inertia_per_mass() const { return 0.25 * (a * a + b * b); }
};

static_assert(Body<Ellipse>);

/// Returns the ellipse with both semi-axes multiplied by `size`.
inline Ellipse scaled(const Ellipse& ellipse, double size) {
  return {size * ellipse.a, size * ellipse.b};
}

/// The perimeter 4 a E(√(1 − b²/a²)), where E is the complete elliptic integral of the second kind.
double perimeter(const Ellipse& ellipse);

/// The shape matrix Σ = R(θ) diag(a², b²) R(θ)ᵀ; the ellipse is the set of x with xᵀ Σ⁻¹ x ≤ 1.
Mat2 shape_matrix(const Ellipse& ellipse, double angle);

}  // namespace vitrel
