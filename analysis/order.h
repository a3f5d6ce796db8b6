#pragma once

#include <cstddef>
#include <vector>

#include "core/state/configuration.h"

/// Order of one configuration: of the angles (nematic) and of the places (hexatic). Ellipses look
/// alike after half a turn, so angles enter as 2θ.
namespace vitrel {

/// Nematic order S = |⟨exp 2iθ⟩| of the particles that are not round: 1 if all are parallel;
/// √(π/(4R)) on the average of R particles without order. 0 if all are round.
double nematic_order(const Configuration2& configuration);

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
/// once; beyond 4096 particles only pairs with one of 4096 (or a few less) evenly picked ones do.
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
HexaticOrder hexatic_order(const Configuration2& configuration);

}  // namespace vitrel
