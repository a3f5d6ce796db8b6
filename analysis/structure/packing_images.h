#pragma once

#include <vector>

#include "core/state/configuration.h"

/// @file
/// The bodies of a periodic packing that fill its box, as a mesh or a voxel grid of one period needs them.
///
/// The box is the cuboid |x_k| ≤ L_k/2. Each particle has infinitely many images, at r + shift ∘ L; exactly those whose
/// body meets the box are listed. Counting the faces that a body crosses is not enough: an image may pass an edge or a
/// corner without meeting the box, and a long body may cross opposite faces.
namespace vitrel {

/// Returns whether body and box have a point in common; a body that only touches the box may be judged either way by
/// rounding.
///
/// They have one if and only if the smallest value of (x − r)ᵀ Σ⁻¹ (x − r) in the box is at most 1. This value is taken
/// inside, on a face, an edge or a corner, that is, with some coordinates C fixed to ±L/2. With d_C the vector from r
/// to there, it is d_Cᵀ Σ_CC⁻¹ d_C, at the free coordinates x_F = r_F + Σ_FC Σ_CC⁻¹ d_C (the marginal and the
/// conditional mean of a Gaussian of covariance Σ). The exact value is the least of those among these 27 values whose
/// point lies in the box.
bool meets_box(const ParticleShape<3>& body, const Pose3& pose, const PeriodicBox<3>& box);

/// The body of `particle` at r + shift ∘ L.
struct BodyInBox {
  std::size_t particle;
  Shift<3> shift;
  bool is_cut;  ///< whether it reaches beyond the box
};

/// Returns all bodies that meet the box, in ascending order of particle and shift; shift 0 of every particle is among
/// them. Positions must be wrapped into the box.
std::vector<BodyInBox> bodies_in_box(const Configuration3& packing);

/// Returns a translation of the box after which no body grazes it, since a whole packing can be moved in its periodic
/// box at will. Meshes of thin slices, and meshes between a body and a side that it all but touches, are poor.
///
/// How far a body is from grazing is measured by the least |√(d_Cᵀ Σ_CC⁻¹ d_C) − 1| over all planes, edges and corners
/// C of the lattice of boxes, which is 0 if the body touches one of them. The translations tried are those in whose
/// every coordinate the planes lie in the middle of one of the widest gaps between the positions x_k = r_k ± √Σ_kk of
/// planes that touch a body.
Vec3 clean_cut(const Configuration3& packing);

/// Returns the least of these distances, with the box moved by `translation`; 1 if no body is near a plane.
double grazing_distance(const Configuration3& packing, const Vec3& translation);

}  // namespace vitrel
