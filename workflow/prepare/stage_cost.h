#pragma once

#include "edmd/hard_fluid.h"
#include "workflow/stages/stage.h"

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
  double goal = 0;              ///< the packing fraction that the stage is to reach (end_of_stage)

  void add(const StageCost& other);
};

/// Growth is that of a fluid up to Z = 20; from there on particles are taken to jam, and Z rises by a factor of e in
/// 1.5/(γ τ) collisions of a particle. A stretch of `hybrid` grows all lengths by 1 %, or near jamming ln Z by 0.15.
/// Swelling takes about 3 √N Z sweeps, as measured for 200 to 1000 disks, ellipses, spheres and ellipsoids between Z = 6
/// and 26. Stages that only place the particles cost nothing.
StageCost expected_cost(const Stage& stage, const StageScene& scene);

}  // namespace vitrel
