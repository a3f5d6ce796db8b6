#pragma once

#include <numbers>

#include "core/elementary.h"
#include "core/geometry/body.h"

namespace vitrel {

/// A hard ellipsoid with semi-axes (a, b, c) > 0 along its own x, y and z axes, in any order.
///
/// The body is homogeneous, with principal moments m (b² + c²)/5 and cyclic permutations.
///
/// Smooth collisions exert no torque about the axis of symmetry of a spheroid, and in free flight its shape rotates
/// uniformly about the angular momentum L with ω = L/I⊥. This ω is the stored angular velocity. With it the spheroid
/// moves like a body with three equal moments I⊥, which is exact, and L = I⊥ ω. This also holds if rough contacts make
/// the spheroid spin about its axis of symmetry a: the true angular velocity is then ω + (I⊥/I∥ − 1)(ω·a) a.
///
/// Scalene bodies tumble by Euler's equations as `TumblingEllipsoid`. As plain ellipsoids they keep ω constant in
/// flight. This is a model (after the article on packing) that does not conserve L, but conserves ω in the body frame
/// and therefore the energy. It also conserves phase-space volume, so all static averages are those of equilibrium.
/// Growing bodies move in this way.
struct Ellipsoid {
  static constexpr int dimension = 3;
  Vec3 semi_axes = Vec3::Ones();

  bool operator==(const Ellipsoid& other) const { return semi_axes == other.semi_axes; }
  double circumradius() const { return semi_axes.maxCoeff(); }
  double inradius() const { return semi_axes.minCoeff(); }
  const Vec3& half_lengths() const { return semi_axes; }
  double volume() const { return 4 * std::numbers::pi / 3 * prod(semi_axes); }
  double size() const { return root(prod(semi_axes), 3); }
  double natural_mass() const { return prod(semi_axes); }
  double max_support_rate() const { return circumradius() - inradius(); }

  bool is_round() const { return semi_axes[0] == semi_axes[1] && semi_axes[1] == semi_axes[2]; }
  bool fits_into(const Ellipsoid& other) const {
    return (semi_axes.array() <= other.semi_axes.array()).all();
  }
  /// 0, 1 or 2 for a spheroid; no_axis if all three semi-axes differ or all are equal.
  int symmetry_axis() const {
    if (is_round()) return no_axis;
    for (int k = 0; k < 3; ++k)
      if (semi_axes[(k + 1) % 3] == semi_axes[(k + 2) % 3]) return k;
    return no_axis;
  }
  /// Whether all three semi-axes differ.
  bool is_scalene() const { return !is_round() && symmetry_axis() == no_axis; }
  /// The number of rotational degrees of freedom that smooth collisions change: 0, 2 or 3.
  int rotations() const { return is_round() ? 0 : is_scalene() ? 3 : 2; }

  /// The principal moments of inertia divided by the mass; for a spheroid, three times I⊥.
  Vec3 inertia_per_mass() const;
  /// The true principal moments divided by the mass, including I∥ of a spheroid.
  Vec3 full_inertia_per_mass() const;
};

static_assert(Body<Ellipsoid>);

/// Returns I⊥/I∥ of a spheroid: the true spin about the axis is this factor times the component of the stored angular
/// velocity along the axis.
inline double spin_factor(const Ellipsoid& spheroid) {
  const Vec3 squares = spheroid.semi_axes.cwiseAbs2();
  const int axis = spheroid.symmetry_axis();
  const double across = squares[(axis + 1) % 3];
  return 0.5 * (squares[axis] + across) / across;
}

/// Returns the ellipsoid with all semi-axes multiplied by `size`.
inline Ellipsoid scaled(const Ellipsoid& ellipsoid, double size) {
  return {size * ellipsoid.semi_axes};
}

/// Returns √Σ_kk, where Σ is the shape matrix: how far the ellipsoid extends from its centre along the axes of space.
/// It touches the plane x_k = β iff |β − r_k| = √Σ_kk.
Vec3 half_extents(const Ellipsoid& ellipsoid, const Quaternion& orientation);

/// The shape matrix Σ = R diag(a², b², c²) Rᵀ; the ellipsoid is the set of x with xᵀ Σ⁻¹ x ≤ 1.
Mat3 shape_matrix(const Ellipsoid& ellipsoid, const Quaternion& orientation);

}  // namespace vitrel
