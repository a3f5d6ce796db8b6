#pragma once

#include <optional>
#include <vector>

#include "analysis/dynamics/correlation.h"
#include "analysis/dynamics/displacement_options.h"
#include "analysis/trajectory.h"

/// @file
/// Motion relative to the cage, in two dimensions.
namespace vitrel {

struct CageRelative {
  std::vector<double> lag;           ///< time differences t > 0
  std::vector<std::size_t> origins;  ///< time origins averaged over, for every lag
  std::vector<double> wave_numbers;
  Correlation square;                        ///< ⟨|Δr_c|²⟩
  std::vector<Correlation> self_scattering;  ///< ⟨J₀(q |Δr_c|)⟩, one for every wave number
  Correlation overlap;                       ///< overlap as in displacement.h, of Δr_c
  Correlation susceptibility;                ///< χ₄ of that overlap
};

/// Measures how particles move relative to their neighbours,
///
///     Δr_c = Δr_i − n_i⁻¹ Σ_j Δr_j,
///
/// where j are the n_i neighbours by Voronoi cells at the origin of time, without own images. In two dimensions
/// long-wavelength fluctuations move whole regions (Mermin and Wagner): the usual displacements grow with the size of
/// the system, and relaxation looks faster than that of the cages. Displacements relative to the cage do not have this
/// effect (vivek2017, illing2017). Independent particles have ⟨|Δr_c|²⟩ = ⟨|Δr|²⟩ (1 + ⟨1/n⟩).
///
/// Lags are those of displacements, with at most 256 origins; with more than 8192 particles there are fewer, down to
/// 32. All positions and the neighbours at the origins are kept, which takes about (16 F + 30 F₀) N bytes for F frames,
/// F₀ of which are origins. If that exceeds `options.memory`, there is no result. Threads share the lags, and the
/// result does not depend on their number. Throws UserError for fewer than two frames.
std::optional<CageRelative> cage_relative(Trajectory2& trajectory,
                                          const DisplacementOptions& options = {},
                                          const ProgressReport& report = {});

}  // namespace vitrel
