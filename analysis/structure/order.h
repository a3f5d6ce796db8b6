#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// The order of one configuration: of the angles (nematic) and of the places (hexatic). Ellipses look alike after half
/// a turn, so angles enter as 2θ.
namespace vitrel {

/// The order tensor Q = ⟨2 u uᵀ − 1⟩ of the particles that are not round, with u along the major axis:
///
///     Q = ( ⟨cos 2θ⟩   ⟨sin 2θ⟩ )
///         ( ⟨sin 2θ⟩  −⟨cos 2θ⟩ ),
///
/// Its eigenvalues are ± S; the eigenvector of + S is the director. Q is 0 if all particles are round.
struct OrderTensor {
  double cosine = 0, sine = 0;  ///< ⟨cos 2θ⟩ and ⟨sin 2θ⟩

  Mat2 matrix() const;
  /// Returns the nematic order S = |⟨exp 2iθ⟩|. It is 1 if all are parallel, but not 0 without order, see
  /// nematic_order_by_chance.
  double order() const;
  /// Returns the angle of the director, from −π/2 to π/2. Without order it is arbitrary.
  double director() const;
};
OrderTensor order_tensor(const Configuration2& configuration);

/// Returns S of order_tensor.
double nematic_order(const Configuration2& configuration);

/// Returns the mean S of R independent axes, which a finite system without any order shows. In two dimensions it is
/// √(π/(4R)), the mean length of a random walk of R steps of length 1/R. In three it is (9/4) √(2/(5πR)), the mean
/// largest eigenvalue of (3 T − 1)/2 with the fluctuations of T as in isotropic_ratio (orientation_tensor.h). The
/// values are good to 1 % from R = 10 and R = 100 on.
double nematic_order_by_chance(std::size_t rotors, int dimension);

/// Returns whether S, averaged over a run, is that of a nematic: above 0.5 (0.4 in three dimensions), and at least
/// three times the value by chance (R rotors of which g always turn together have √g times as much). In two dimensions
/// order decays as a power of the distance, with an exponent of at most 1/4 (frenkel1985), hence S falls with the box;
/// but as S² ≈ 1.1 (box/2 particles)^(−1/4), it is above 0.5 in every box shorter than some hundred particles. In three
/// dimensions S jumps to 0.5 or more at the transition (frenkelmulder1985).
bool is_nematic(double order, std::size_t rotors, int dimension = 2);

/// Returns the density of the angles between the particles that are not round and the director, in bins of equal width
/// from −π/2 to π/2; its integral is 1. The director is that of the same particles, so without order the density is
/// (1 + 2 S cos 2α)/π, not 1/π, with the S of a finite system. Empty if all are round.
std::vector<double> orientation_distribution(const Configuration2& configuration, std::size_t bins);

/// g₂(r) = ⟨cos 2(θ_i − θ_j)⟩ over the pairs of particles that are not round, by the distance r of their centres. Bins
/// of equal width fill 0 … half the shorter side of the box, so that the nearest image is the only one. g₂ is 1 where
/// all are parallel, and 0 without order. At large distances it is S² if there is long-range order, and decays by a
/// power of r if order is quasi-long-ranged, which is the most there can be in two dimensions (frenkel1985).
struct NematicCorrelation {
  std::vector<double> distance;    ///< middle of the bin
  std::vector<double> value;       ///< NaN in a bin without pairs
  std::vector<std::size_t> pairs;  ///< independent angles scatter by 1/√(2 pairs)
};
/// Returns g₂ in bins of about this width, which is rounded so that a whole number of bins fits. Every pair counts
/// once. Beyond 4096 particles only pairs with one of 4096 (or a few less) evenly picked ones count, and beyond 32 768
/// only pairs with one of 2²⁷/N; the cost then is O(N). `pairs` says how many there were. Empty without two particles
/// that are not round.
NematicCorrelation nematic_correlation(const Configuration2& configuration, double width);
/// Returns the distance beyond which g₂ stays below 1/e: the far end of the last bin where it does not. It is 0 if g₂
/// is nowhere above, and infinity if it is above in the last bin with pairs, at half the box.
double correlation_length(const NematicCorrelation& correlation);

/// The hexatic order of the centres, ψ_j = Σ_k l_jk exp(6iα_jk)/Σ_k l_jk, summed over the Voronoi neighbours k of j.
/// Here α_jk is the direction from j to k, and l_jk the length of the edge that their cells share (mickel2013). These
/// weights need no cutoff, and make ψ a continuous function of the positions: a neighbour about to be lost has an edge
/// about to vanish. Plain counting jumps there, and is undefined on the square lattice.
struct HexaticOrder {
  double global;  ///< |⟨ψ_j⟩|: 1 on the triangular lattice, 0 on the square one and in the liquid
  double local;  ///< ⟨|ψ_j|⟩: the same on lattices, but well above 0 in every liquid
};
/// The result does not depend on the number of threads.
HexaticOrder hexatic_order(const Configuration2& configuration, int threads = 1);
/// Returns ψ_j of every particle.
std::vector<std::complex<double>> local_hexatic_orders(const Configuration2& configuration,
                                                       int threads = 1);

}  // namespace vitrel
