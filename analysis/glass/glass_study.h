#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/glass/glass_fit.h"
#include "analysis/glass/glass_run.h"

/// @file
/// Finds out where particles cease to move and to turn, from runs at several densities.
namespace vitrel {

/// The times that a law is fitted to.
enum class GlassKind {
  translation,       ///< τ_α, in the plane relative to the cage
  rotation,          ///< τ_2 of runs that are not nematic
  nematic_rotation,  ///< τ_2 of nematic runs
};
inline constexpr std::array glass_kinds = {GlassKind::translation, GlassKind::rotation,
                                           GlassKind::nematic_rotation};

/// Whether the diffusion coefficient of the same motion, D or D_r, confirms a φ_c.
enum class DiffusionVerdict {
  untested,   ///< D supports no law, or nothing diffuses (rotation in a nematic)
  agrees,     ///< the φ_c of 1/D is within three standard errors, or not bounded from above
  disagrees,  ///< the φ_c of 1/D is farther away
};

struct StudiedLaw {
  GlassKind kind;
  GlassLaw law;
  GlassFit fit;
  DiffusionVerdict diffusion;
};

struct GlassStudy {
  std::vector<GlassRun> runs;    ///< in the order given
  std::vector<StudiedLaw> laws;  ///< both laws for every kind of which some run has a time
  /// What else must be known, such as why there are no laws.
  std::vector<std::string> remarks = {};
};

/// Fits both laws for all kinds, to the runs that were in equilibrium and have a time with an error; for translation,
/// the verdict on translation counts. The same law of 1/D, or 1/D_r, only confirms φ_c or does not: a motion ceases at
/// one density, so that there is one statement. Runs that differ in more than density, seed and duration follow no
/// common law: `mixed` names what differs, and then none is fitted.
GlassStudy study_glass(std::vector<GlassRun> runs, std::string mixed = "");

}  // namespace vitrel
