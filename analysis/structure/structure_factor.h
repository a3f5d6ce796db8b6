#pragma once

#include <cstddef>
#include <vector>

#include "analysis/structure/density_grid.h"
#include "analysis/structure/structure_options.h"
#include "core/state/configuration.h"

/// @file
/// Static structure factors of one configuration, averaged over wave vectors of about the same length.
namespace vitrel {

/// One entry per shell of wave numbers, the k-th from k to k + 1 steps. Let ρ_α(q) = Σ_j exp(−i q·r_j), summed over the
/// particles of species α, and N_α their number. Then
///
///     S(q) = |Σ_α ρ_α|²/N,  S_αβ(q) = Re ρ_α ρ_β^*/√(N_α N_β),  S = Σ_αβ √(x_α x_β) S_αβ,
///
/// where each is averaged over the wave vectors of the shell. S = S_αα = 1 and S_αβ = 0 in an ideal gas.
struct StructureFactor {
  std::vector<double> modes;  ///< wave vectors in the shell, q and −q counted once; may be 0
  std::vector<double> q;      ///< their mean length; NaN, like all that follows, without any
  std::vector<double> total;
  /// S_αβ for α ≤ β: AA, AB … BB …; empty for a single species. It is NaN where a species has no particles.
  std::vector<std::vector<double>> partial;
  /// S(q) of the field exp(2iθ) of the R particles that are not round, averaged over q and −q,
  ///
  ///     (|Σ_j cos 2θ_j exp(−i q·r_j)|² + |Σ_j sin 2θ_j exp(−i q·r_j)|²)/R:
  ///
  /// It is 1 for independent angles, equals S(q) of the centres where all are parallel, and is the larger at small q
  /// the farther the nematic order reaches. Empty if all are round, and in three dimensions.
  std::vector<double> orientation;
};

/// The wave vectors of a box in shells, and the structure factors on them.
///
/// A density grid (density_grid.h) of about 2¹⁸ nodes gives all modes up to some wave number. Beyond it, the box is
/// folded: positions modulo half a side have the same ρ(q) at every second wave vector along that side, and the same
/// grid reaches twice as far (colombi2009). The cost thus grows with log q_max, and shells at large q are sampled by
/// fewer of their very many wave vectors: in each direction every 2nd, 4th … along the sides that are not much shorter
/// than the longest. With the default shells there are never more than about 10⁵, however large the box.
///
/// For few particles, direct sums over the same wave vectors are taken, which are exact up to rounding.
///
/// Errors: each ρ_α(q) is off by at most ε N_α, where ε = alias_tolerance; hence S is off by at most 2 ε √(N S) + ε² N,
/// in liquids about ε √S. Only one thread at a time may make or destroy these objects; otherwise they have no state.
template <int Dim>
class ScatteringShells {
 public:
  ScatteringShells(const Vec<Dim>& lengths, const ShellOptions& options);

  /// Returns the structure factor of a configuration in a box of these lengths, by the faster one of the two ways
  /// below.
  StructureFactor structure_factor(const Configuration<Dim>& configuration) const;
  StructureFactor transformed_structure_factor(const Configuration<Dim>& configuration) const;
  StructureFactor direct_structure_factor(const Configuration<Dim>& configuration) const;

  /// Up to this number of particles direct sums are the faster way, whatever the box. They cost 3 to 5 ns per particle
  /// and wave vector; a transform costs about the same per node, of which there are 2/(π 0.24²) = 11 per wave vector,
  /// and little per particle. Both ways are measured to be equally fast with 8 to 32 disks or 16 to 30 ellipses of one
  /// or two species, at packing fractions from 0.1 to 0.8. In three dimensions there are 3/(2π 0.24³) = 35 nodes per
  /// wave vector, and the limit is measured at 50 to 80 particles.
  static constexpr std::size_t max_summed_directly = Dim == 2 ? 16 : 64;

 private:
  struct Level {
    Vec<Dim> lengths;  // lengths of the folded box
    DensityGrid<Dim> grid;
    std::size_t first_shell, end_shell;
  };

  StructureFactor averaged(const Configuration<Dim>& configuration, bool direct) const;

  double step_;
  std::size_t shells_;
  std::vector<Level> levels_;
};

/// Returns the names of the partial structure factors, "A_A", "A_B" … in their order.
std::vector<std::string> pair_names(const std::vector<std::string>& species_names);

}  // namespace vitrel
