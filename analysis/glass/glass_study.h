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
  translation,           ///< τ_α
  rotation,              ///< τ_2 of runs that are not nematic
  nematic_rotation,      ///< τ_2 of nematic runs
  diffusion,             ///< 1/D
  rotational_diffusion,  ///< 1/D_r of runs that are not nematic
};
inline constexpr std::array glass_kinds = {GlassKind::translation, GlassKind::rotation,
                                           GlassKind::nematic_rotation, GlassKind::diffusion,
                                           GlassKind::rotational_diffusion};

struct StudiedLaw {
  GlassKind kind;
  GlassLaw law;
  GlassFit fit;
};

struct GlassStudy {
  std::vector<GlassRun> runs;    ///< in the order given
  std::vector<StudiedLaw> laws;  ///< both laws for every kind that some run has a time of
  std::vector<std::string> remarks =
      {};  ///< what else must be known, such as why there are no laws
};

/// Both laws for all kinds, from the runs that were in equilibrium and have a time with an error;
/// translation and diffusion by the verdict of translation. Of runs that differ in more than density,
/// seed and duration no law holds: `mixed` names what differs, and then none is fitted.
GlassStudy study_glass(std::vector<GlassRun> runs, const std::string& mixed = "");

}  // namespace vitrel
