#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry/vector.h"

/// @file
/// Fourier modes of weighted points in a periodic box, all computed at once.
namespace vitrel {

/// A wave vector q = 2π (n_x/L_x, n_y/L_y …).
template <int Dim>
struct WaveVector {
  std::array<int, Dim> n;
  double wave_number;  ///< |q|
};

/// One weight per point. Several fields may share the points.
using Weights = std::vector<double>;
/// ρ(q) = Σ_j w_j exp(−i q·r_j), one number per wave vector.
using Modes = std::vector<std::complex<double>>;

/// The order p of the cardinal B-splines that spread the points over the grid.
inline constexpr int spline_order = 12;
/// The grid is so fine that its spacing h satisfies q h ≤ 2π · largest_grid_wave; then alias_bound ≤ alias_tolerance.
inline constexpr double largest_grid_wave = 0.24;
inline constexpr double alias_tolerance = 1e-6;

/// Returns a bound of the aliasing at x = q h/2π, |x_k| < 1/2 (q_k h_k in every direction):
///
///     ε = Π_k A(x_k) − 1,  A(x) = Σ_m |x/(x + m)|^p over all whole m.
template <int Dim>
double alias_bound(const Vec<Dim>& x);

/// Computes ρ(q) by a Fourier transform (essmann1995).
///
/// 1. Every point spreads its weight over the p^D nearest nodes of a grid, with the cardinal
///    B-spline of order p in each direction.
/// 2. The discrete Fourier transform of the grid is ρ(q) ŵ(q) and its images ρ(q') ŵ(q'), q' = q +
///    2π m/h with whole numbers m, where ŵ(q) = Π_k (sin(q_k h_k/2)/(q_k h_k/2))^p.
/// 3. After division by ŵ(q), every image is left with the factor ± Π_k |x_k/(x_k + m_k)|^p.
/// |ρ(q')| is at most Σ|w_j|, so, apart from rounding,
///
///     |error of ρ(q)| ≤ alias_bound(q h/2π) Σ_j |w_j| ≤ alias_tolerance Σ_j |w_j|.
///
/// A lattice in step with the grid reaches this bound; for points without order the error is about √N/N of it. The cost
/// is p^D per point and field, and that of a transform of Π_k L_k to/(2π · 0.24) nodes per field.
///
/// The plan of the transform does not depend on measured times, so equal points give equal modes.
template <int Dim>
class DensityGrid {
 public:
  /// Makes a grid for the wave vectors with from ≤ |q| < to, except q = 0.
  DensityGrid(const Vec<Dim>& lengths, double from, double to);
  ~DensityGrid();
  DensityGrid(DensityGrid&&) noexcept;

  /// Returns one of each q and −q, since ρ(−q) is the conjugate of ρ(q).
  const std::vector<WaveVector<Dim>>& wave_vectors() const { return wave_vectors_; }
  /// Returns h in every direction.
  Vec<Dim> spacing() const;
  /// Returns the modes of the wave vectors, in their order, for every field. Positions need not be wrapped.
  std::vector<Modes> modes(std::span<const Vec<Dim>> positions,
                           const std::vector<Weights>& fields) const;

  /// Returns about how many nodes a grid takes for wave numbers up to this one.
  static double nodes(const Vec<Dim>& lengths, double to);

 private:
  struct Transform;
  struct Place;

  void list_wave_vectors(double from, double to);
  void list_row(WaveVector<Dim> wave, double from, double to);
  void list(const WaveVector<Dim>& wave);
  std::vector<Place> places(std::span<const Vec<Dim>> positions) const;
  void spread(const Place& place, const std::vector<Weights>& fields,
              const std::vector<double*>& grids) const;
  void close_period(double* grid) const;

  Vec<Dim> lengths_;
  std::array<int, Dim> count_;          // number of nodes
  std::array<std::size_t, Dim> pitch_;  // numbers from node to node, with those beyond the period
  std::vector<WaveVector<Dim>> wave_vectors_;
  std::vector<std::size_t> index_;  // place of each wave vector in the transformed grid
  std::vector<double> gain_;        // 1/ŵ, and the sign for an origin in the middle of the box
  std::unique_ptr<Transform> transform_;
};

/// Computes the modes by direct sums, exact up to rounding. The cost is (points) × (wave vectors) per field.
template <int Dim>
std::vector<Modes> direct_modes(const Vec<Dim>& lengths,
                                const std::vector<WaveVector<Dim>>& wave_vectors,
                                const std::vector<Vec<Dim>>& positions,
                                const std::vector<Weights>& fields);

}  // namespace vitrel
