#pragma once

#include <optional>

#include "analysis/dynamics/cage_relative.h"
#include "analysis/dynamics/diffusion.h"
#include "analysis/dynamics/displacement.h"
#include "analysis/dynamics/energy.h"
#include "analysis/glass/glass_study.h"
#include "analysis/observables/frame_observable.h"

namespace vitrel {

/// What the analysis has found out about one run.
struct GlassSource {
  std::string name;
  std::uint64_t seed;
  double packing_fraction;
  std::size_t rotors;
  bool starts_in_equilibrium;  ///< its first state was drawn from equilibrium
  const Displacements& displacements;
  const CageRelative* cage_relative;  ///< null if it was not measured
  const CompressibilitySeries& compressibility;
  const OrderSeries& order;
  const DiffusionCoefficient& diffusion;
  const DiffusionCoefficient& rotational_diffusion;
};

/// Returns what the glass study needs of a run: F_s at the first of the wave numbers, relative to the cage if that is
/// known, L_2 (of a nematic seen from its director), order, diffusion, and curves once more from each half of the run.
/// Returns no value for runs that are not evenly sampled, because these cannot be judged. `report` is called with the
/// share of the particles of all passes that are done.
template <int Dim>
std::optional<GlassRunData> glass_run_data(Trajectory<Dim>& trajectory, const GlassSource& run,
                                           const DisplacementOptions& options,
                                           const ProgressReport& report = {});

}  // namespace vitrel
