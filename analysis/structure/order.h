#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// Order of one configuration: of the angles (nematic) and of the places (hexatic). Ellipses look
/// alike after half a turn, so angles enter as 2θ.
namespace vitrel {

/// The order tensor Q = ⟨2 u uᵀ − 1⟩, u along the major axis, of the particles that are not round:
///
///     Q = ( ⟨cos 2θ⟩   ⟨sin 2θ⟩ )
///         ( ⟨sin 2θ⟩  −⟨cos 2θ⟩ ),
///
/// with the eigenvalues ± S; the eigenvector of + S is the director. 0 if all are round.
struct OrderTensor {
  double cosine = 0, sine = 0;  ///< ⟨cos 2θ⟩ and ⟨sin 2θ⟩

  Mat2 matrix() const;
  /// Nematic order S = |⟨exp 2iθ⟩|: 1 if all are parallel, and not 0 without order, see
  /// nematic_order_by_chance.
  double order() const;
  /// Angle of the director, from −π/2 to π/2; without order any.
  double director() const;
};
OrderTensor order_tensor(const Configuration2& configuration);

/// S, for short.
double nematic_order(const Configuration2& configuration);

/// Mean S of R independent axes: what a finite system without any order shows. In two dimensions
/// √(π/(4R)), the mean length of a random walk of R steps of length 1/R. In three (9/4) √(2/(5πR)), the
/// mean largest eigenvalue of (3 T − 1)/2 with the fluctuations of T as in isotropic_ratio
/// (orientation_tensor.h). Good to 1 % from R = 10 and R = 100 on.
double nematic_order_by_chance(std::size_t rotors, int dimension);

/// Whether S, averaged over a run, is that of a nematic: above 0.5 (0.4 in three dimensions), and three
/// times that of chance at least (R rotors of which g always turn together have √g times as much). In two
/// dimensions order decays as a power of the distance, with an exponent of 1/4 at most (frenkel1985),
/// hence S falls with the box; but as S² ≈ 1.1 (box/2 particles)^(−1/4) it is above 0.5 in every box
/// shorter than some hundred particles. In three, S jumps to 0.5 or more at the transition
/// (frenkelmulder1985).
bool is_nematic(double order, std::size_t rotors, int dimension = 2);

/// Density of the angles of the particles that are not round, seen from the director, in bins of equal
/// width from −π/2 to π/2; its integral is 1. The director is that of the same particles: without
/// order it is (1 + 2 S cos 2α)/π, not 1/π, with the S of a finite system. Empty if all are round.
std::vector<double> orientation_distribution(const Configuration2& configuration, std::size_t bins);

/// g₂(r) = ⟨cos 2(θ_i − θ_j)⟩ over the pairs of particles that are not round, by the distance r of
/// their centres. Bins of equal width fill 0 … half the shorter side of the box, so that the
/// nearest image is the only one. 1 where all are parallel, 0 without order; S² far out, if there
/// is order of long range, and decaying by a power of r if it is quasi-long-ranged, the most there
/// can be in two dimensions (frenkel1985).
struct NematicCorrelation {
  std::vector<double> distance;    ///< middle of the bin
  std::vector<double> value;       ///< NaN in a bin without pairs
  std::vector<std::size_t> pairs;  ///< independent angles scatter by 1/√(2 pairs)
};
/// `width` of a bin, about; it is rounded so that a whole number of bins fits. Every pair counts
/// once; beyond 4096 particles only pairs with one of 4096 (or a few less) evenly picked ones do, beyond 32 768 with
/// one of 2²⁷/N: cost O(N) then. `pairs` tells how many there were.
/// Empty without two particles that are not round.
NematicCorrelation nematic_correlation(const Configuration2& configuration, double width);
/// The distance beyond which g₂ stays below 1/e: the far end of the last bin where it does not. 0
/// if it is nowhere above; infinity if it is in the last bin with pairs, at half the box.
double correlation_length(const NematicCorrelation& correlation);

/// Hexatic order of the centres, ψ_j = Σ_k l_jk exp(6iα_jk)/Σ_k l_jk over the Voronoi neighbours k
/// of j: α_jk is the direction from j to k, l_jk the length of the edge that their cells share
/// (mickel2013). These weights need no cutoff, and make ψ a continuous function of the positions: a
/// neighbour about to be lost has an edge about to vanish. Plain counting jumps there, and is
/// undefined on the square lattice.
struct HexaticOrder {
  double global;  ///< |⟨ψ_j⟩|: 1 on the triangular lattice, 0 on the square one and in the liquid
  double local;  ///< ⟨|ψ_j|⟩: the same on lattices; well above 0 in every liquid
};
/// The result does not depend on the number of threads.
HexaticOrder hexatic_order(const Configuration2& configuration, int threads = 1);
/// ψ_j of every particle.
std::vector<std::complex<double>> local_hexatic_orders(const Configuration2& configuration,
                                                       int threads = 1);

}  // namespace vitrel
