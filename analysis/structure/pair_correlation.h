#pragma once

#include <cstddef>
#include <vector>

#include "analysis/structure/structure_options.h"
#include "core/state/configuration.h"

/// @file
/// Pair correlations of one configuration by the distance r of the centres.
namespace vitrel {

/// One entry per bin. The k-th bin goes from k to k + 1 steps; as many whole bins are made as fit below distance_max
/// and half the shortest side of the box, so that the nearest image is the only one.
struct PairCorrelation {
  std::vector<double> distance;  ///< middle of the bin
  /// g(r): pairs in the bin over N (N − 1)/2 · π(r₂² − r₁²)/(L_x L_y), in three dimensions
  /// N (N − 1)/2 · 4π(r₂³ − r₁³)/(3 L_x L_y L_z), the number for N particles anywhere. It is 1 on the average at every
  /// r in an ideal gas, and in a liquid at large r up to O(1/N).
  std::vector<double> g;
  /// g_AB of the pairs of species A ≤ B, in the order AA, AB … BB …: pairs in the bin over N_A N_B, for equal species
  /// N_A (N_A − 1)/2, times the same fraction of the box. Each is 1 in an ideal gas, and g is their mean, weighted with
  /// these numbers of pairs. An entry is empty if there is no such pair, as AA of a single particle, and there are no
  /// entries unless several species have particles.
  std::vector<std::vector<double>> partial;
  /// g_n(r) = ⟨cos n(θ_i − θ_j)⟩ over the pairs of particles that are not round, in three dimensions Legendre's
  /// ⟨P_n(u_i·u_j)⟩ of the figure axes u (orientation_tensor.h): 1 where all are parallel, 0 without order. It is NaN
  /// in a bin without such pairs, and everywhere if there are no two such particles.
  std::vector<double> g_2, g_4;
  std::vector<double> rotor_pairs;  ///< number of pairs behind g_2 and g_4
};

/// Returns the correlations over all pairs, which are found by cells: the cost is N · (particles within distance_max).
template <int Dim>
PairCorrelation pair_correlation(const Configuration<Dim>& configuration,
                                 const PairCorrelationOptions& options = {});

/// Number of bins of the angle θ between a separation and an axis, from 0 to π/2 since opposite directions are
/// equivalent. All bins have the same share of the directions: in the plane they are uniform in θ, 10° each, and in
/// three dimensions uniform in cos θ, 0.1 each.
template <int Dim>
inline constexpr std::size_t axis_angle_bins = Dim == 2 ? 9 : 10;

/// g(r, θ), which shows whether neighbours are in line with a particle or beside it. θ is the angle between the
/// separation of the centres and the long axis of the first particle, or in three dimensions its figure axis
/// (figure_axis.h), which is the short axis of an oblate spheroid.
struct PairCorrelationByAngle {
  std::vector<double> distance;  ///< middle of the bin
  /// One row for each bin of θ, ascending: ordered pairs (i, j) in the bin, where i is one of the R particles that are
  /// not round and j any other particle, over those of an ideal gas, R (N − 1) times the fraction of the box. It is 1
  /// on the average at every r and θ in an ideal gas. If no particle is round, the mean of the rows is g(r).
  std::vector<std::vector<double>> g;
};

/// The bins of r are those of g(r) up to this many times the longest diameter of any particle. A second neighbour
/// in line is 2 of these diameters away; farther pairs hardly depend on θ, and are most of the pairs.
inline constexpr double axis_angle_range = 2.5;

/// Returns g(r, θ), which is empty if all particles are round. The cost is N · (particles within the range).
template <int Dim>
PairCorrelationByAngle pair_correlation_by_angle(const Configuration<Dim>& configuration,
                                                 const PairCorrelationOptions& options = {});

}  // namespace vitrel
