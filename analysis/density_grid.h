#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry/vector.h"

/// Fourier modes of weighted points in a periodic box, all of them at once.
namespace vitrel {

/// q = 2π (n_x/L_x, n_y/L_y).
struct WaveVector {
  int x, y;            ///< n_x, n_y
  double wave_number;  ///< |q|
};

/// One weight per point. Several fields share the points.
using Weights = std::vector<double>;
/// ρ(q) = Σ_j w_j exp(−i q·r_j), one per wave vector.
using Modes = std::vector<std::complex<double>>;

/// Order p of the cardinal B-splines that spread the points over the grid.
inline constexpr int spline_order = 12;
/// The grid is so fine that q h ≤ 2π · this, h its spacing: then alias_bound ≤ alias_tolerance.
inline constexpr double largest_grid_wave = 0.24;
inline constexpr double alias_tolerance = 1e-6;

/// Bound of the aliasing at x = q h/2π, |x_k| < 1/2 (q_k h_k in both directions):
///   ε = A(x_x) A(x_y) − 1,  A(x) = Σ_m |x/(x + m)|^p over all whole m.
double alias_bound(const Vec2& x);

/// ρ(q) by a Fourier transform (essmann1995).
///
/// 1. Every point spreads its weight over the p × p nearest nodes of a grid, with the cardinal
///    B-spline of order p in each direction.
/// 2. The discrete Fourier transform of the grid is ρ(q) ŵ(q) and its images ρ(q') ŵ(q'), q' = q +
///    2π m/h with whole numbers m, where ŵ(q) = Π_k (sin(q_k h_k/2)/(q_k h_k/2))^p.
/// 3. Divided by ŵ(q), every image is left with the factor ± Π_k |x_k/(x_k + m_k)|^p.
/// |ρ(q')| is at most Σ|w_j|, so, rounding apart,
///   |error of ρ(q)| ≤ alias_bound(q h/2π) Σ_j |w_j| ≤ alias_tolerance Σ_j |w_j|.
/// A lattice in step with the grid comes up to it; for points without order the error is about
/// √N/N of that. Cost p² per point and field, and that of a transform of
/// L_x L_y (to/(2π · 0.24))² nodes per field.
///
/// To be made and destroyed by one thread at a time (FFTW's planner); `modes` may be called by many.
/// The plan is one that does not depend on measured times, so equal points give equal modes.
class DensityGrid {
 public:
  /// For the wave vectors with from ≤ |q| < to, except q = 0.
  DensityGrid(const Vec2& lengths, double from, double to);
  ~DensityGrid();
  DensityGrid(DensityGrid&&) noexcept;

  /// One of each q and −q, since ρ(−q) is the conjugate of ρ(q).
  const std::vector<WaveVector>& wave_vectors() const { return wave_vectors_; }
  /// h in both directions.
  Vec2 spacing() const { return {lengths_.x() / count_[0], lengths_.y() / count_[1]}; }
  /// For every field the modes of the wave vectors, in their order. Positions need not be wrapped.
  std::vector<Modes> modes(std::span<const Vec2> positions,
                           const std::vector<Weights>& fields) const;

  /// How many nodes a grid takes for wave numbers up to this one, about.
  static double nodes(const Vec2& lengths, double to);

 private:
  struct Transform;

  void list_wave_vectors(double from, double to);
  struct Place;

  std::vector<Place> places(std::span<const Vec2> positions) const;
  void spread(const Place& place, const std::vector<Weights>& fields,
              const std::vector<double*>& grids) const;
  void close_period(double* grid) const;

  Vec2 lengths_;
  int count_[2];     // nodes
  std::size_t row_;  // numbers in a row of the grid, with those beyond the period
  std::vector<WaveVector> wave_vectors_;
  std::vector<std::size_t> index_;  // of each wave vector, in the transformed grid
  std::vector<double> gain_;        // 1/ŵ, and the sign for an origin in the middle of the box
  std::unique_ptr<Transform> transform_;
};

/// The same by direct sums, exact up to rounding: cost (points) × (wave vectors) per field.
std::vector<Modes> direct_modes(const Vec2& lengths, std::span<const WaveVector> wave_vectors,
                                std::span<const Vec2> positions,
                                const std::vector<Weights>& fields);

}  // namespace vitrel
