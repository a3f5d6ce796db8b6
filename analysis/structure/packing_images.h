#pragma once

#include <vector>

#include "core/state/configuration.h"

/// @file
/// The bodies of a periodic packing that fill its box: what a mesh or a voxel grid of one period needs.
///
/// The box is the cuboid |x_k| ≤ L_k/2. Each particle has infinitely many images, at r + shift ∘ L; those
/// whose body meets the box, and no others, are listed. Counting the faces that a body crosses is not
/// enough: an image may pass an edge or a corner without meeting the box, and a long body may cross
/// opposite faces.
namespace vitrel {

/// Whether body and box have a point in common; a body that only touches the box may be judged either way
/// by rounding.
///
/// That is so iff the smallest value of (x − r)ᵀ Σ⁻¹ (x − r) in the box is at most 1. It is taken inside, on a
/// face, an edge or a corner, that is, with some coordinates C fixed to ±L/2. By the d_C from r to there it
/// is d_Cᵀ Σ_CC⁻¹ d_C, at the free coordinates x_F = r_F + Σ_FC Σ_CC⁻¹ d_C (the marginal and the conditional
/// mean of a Gaussian of covariance Σ). Of these 27 values that of the least is exact whose point lies in the
/// box.
bool meets_box(const ParticleShape<3>& body, const Pose3& pose, const PeriodicBox<3>& box);

/// The body of `particle`, seen at r + shift ∘ L.
struct BodyInBox {
  std::size_t particle;
  Shift<3> shift;
  bool is_cut;  ///< reaches beyond the box
};

/// All bodies that meet the box, in ascending order of particle and shift; shift 0 of every particle is
/// among them. Positions must be wrapped into the box.
std::vector<BodyInBox> bodies_in_box(const Configuration3& packing);

/// Whole packings can be moved in their periodic box at will. This is the translation of the box after which
/// no body grazes it: meshes of thin slices, and between a body and a side that it all but touches, are poor.
///
/// How far a body is from grazing is the least |√(d_Cᵀ Σ_CC⁻¹ d_C) − 1| over all planes, edges and corners C
/// of the lattice of boxes: 0 if it touches one of them. Tried are translations in whose every coordinate
/// the planes lie amid one of the widest gaps between their positions x_k = r_k ± √Σ_kk that touch a body.
Vec3 clean_cut(const Configuration3& packing);

/// The least of these distances with the box moved by `translation`; 1 if no body is near a plane.
double grazing_distance(const Configuration3& packing, const Vec3& translation);

}  // namespace vitrel
