#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// Two-point statistics of the phase that the particles of a packing form.
namespace vitrel {

/// The statistics at the distances r from 0 to half the shortest side of the box:
///
///     S₂(r)   the probability that two points at the distance r lie in particles, averaged over directions;
///             S₂(0) = φ, S₂ → φ² without long-range order, slope −s/4 at 0 with the specific surface s
///     L_k(r)  the lineal path: the probability that a segment of length r along the axis k lies in particles
///
/// S₂ comes from a grid of points that are one if they lie in a particle and zero if not (its Fourier transform,
/// squared and transformed back, counts all pairs of points). It is averaged over shells of the width of the spacing; r
/// is the mean distance of the shell. Every pair counts with its exact distance, so a finite spacing causes noise, of
/// the relative order of that of S₂(0) = φ on the grid, but no bias, unless all particles lie alike on the grid (a
/// lattice in step with it).
///
/// L is exact: hard convex particles only touch, so the segment lies in one of them, and
///
///     L_k(r) = Σ_j V_j/V f(r √(Σ_j⁻¹)_kk),  f(x) = 1 − 3x/4 + x³/16 for x ≤ 2, else 0,
///
/// where Σ_j is the shape matrix: a particle and its copy shifted by r overlap like two unit spheres at the distance x.
/// Source: torquato2002.
struct TwoPointStatistics {
  double spacing = 0;  ///< largest distance of neighbouring points of the grid
  std::vector<double> distance;
  std::vector<double> probability;                 ///< S₂
  std::array<std::vector<double>, 3> lineal_path;  ///< along x, y, z
};

/// Measures configurations without overlaps in a box with the sides of the first one.
class TwoPointGrid {
 public:
  /// The spacing is an eighth of the smallest inradius, or wider so that there are at most about 2¹⁸ points.
  explicit TwoPointGrid(const Configuration3& first);
  ~TwoPointGrid();
  TwoPointGrid(TwoPointGrid&&) noexcept;

  TwoPointStatistics measure(const Configuration3& configuration) const;

 private:
  struct Transforms;
  struct Shells;

  std::vector<double> probabilities(const Configuration3& configuration) const;
  void mark(double* grid, const Mat3& shape_matrix, const Vec3& position) const;
  int node_below(double coordinate, int axis) const;

  Vec3 lengths_, spacing_;
  std::array<int, 3> count_;
  std::unique_ptr<Transforms> transforms_;
  std::unique_ptr<Shells> shells_;
};

}  // namespace vitrel
