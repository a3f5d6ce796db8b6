#pragma once

#include <cstdint>
#include <optional>

#include "edmd/hard_fluid.h"
#include "mc/options.h"

/// @file
/// What a stage is expected to cost, for a plan: good to a factor of two or three.
namespace vitrel {

/// Where a stage begins.
struct StageScene {
  const HardFluid& fluid;
  double particles;
  double typical_time;      ///< of the particles (typical_scales.h)
  double packing_fraction;  ///< at the start
  double end;               ///< end_of_stage
};

struct StageCost {
  double events = 0;            ///< of growth
  double sweeps = 0;            ///< of Monte Carlo
  double seconds = 0;           ///< on one core of a processor of our days
  bool is_foreseen = true;      ///< false: how many sweeps it takes shows only when they are made
  double packing_fraction = 0;  ///< at the end

  void add(const StageCost& other);
};

/// Of sweeps at the packing fraction at the start.
StageCost cost_of_sweeps(const StageScene& scene, double sweeps, Moves moves);

/// Of growth to the end, or to a reduced pressure if one is given; from Z = 20 on particles are taken to jam: Z rises by
/// a factor of e in 1.5/(γ τ) collisions of a particle.
StageCost cost_of_growth(const StageScene& scene, double growth_rate,
                         const std::optional<double>& reduced_pressure);

/// The number of stretches in which such a growth is made if each increases all lengths by 1 %, or by 0.2/Z.
double growth_stretches(const StageScene& scene, const std::optional<double>& reduced_pressure);

/// Of swelling: about 3 √N Z sweeps, as measured for 200 to 1000 disks, ellipses, spheres and ellipsoids between
/// Z = 6 and 26.
StageCost cost_of_swelling(const StageScene& scene);

}  // namespace vitrel
