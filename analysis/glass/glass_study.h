#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/glass/glass_fit.h"
#include "analysis/glass/glass_run.h"

/// @file
/// Where particles cease to move and to turn, from runs at several densities.
namespace vitrel {

/// What a law is fitted to.
enum class GlassKind {
  translation,       ///< τ_α, in the plane that relative to the cage
  rotation,          ///< τ_2 of runs that are not nematic
  nematic_rotation,  ///< τ_2 of nematic runs
};
inline constexpr std::array glass_kinds = {GlassKind::translation, GlassKind::rotation,
                                           GlassKind::nematic_rotation};

/// What the diffusion coefficient of the same motion, D or D_r, says to a φ_c.
enum class DiffusionVerdict {
  untested,   ///< it supports no law, or nothing diffuses (rotation in a nematic)
  agrees,     ///< the φ_c of 1/D is within three standard errors, or not bounded from above
  disagrees,  ///< it is not
};

struct StudiedLaw {
  GlassKind kind;
  GlassLaw law;
  GlassFit fit;
  DiffusionVerdict diffusion;
};

struct GlassStudy {
  std::vector<GlassRun> runs;    ///< in the order given
  std::vector<StudiedLaw> laws;  ///< both laws for every kind that some run has a time of
  std::vector<std::string> remarks =
      {};  ///< what else must be known, such as why there are no laws
};

/// Both laws for all kinds, from the runs that were in equilibrium and have a time with an error;
/// translation by the verdict of translation. The same law of 1/D, or 1/D_r, only confirms φ_c or does not: a
/// motion ceases at one density, so that there is one statement. Of runs that differ in more than
/// density, seed and duration no law holds: `mixed` names what differs, and then none is fitted.
GlassStudy study_glass(std::vector<GlassRun> runs, std::string mixed = "");

}  // namespace vitrel
