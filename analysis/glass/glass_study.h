#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/dynamics/diffusion.h"
#include "analysis/dynamics/equilibration.h"
#include "analysis/dynamics/relaxation.h"
#include "analysis/glass/glass_fit.h"
#include "analysis/results.h"
#include "analysis/statistics/blocking.h"

/// Where particles cease to move and to turn, from runs at several densities.
namespace vitrel {

/// What the analysis of one run hands over.
struct GlassRunData {
  std::string name;
  double packing_fraction;
  std::uint64_t seed;
  std::size_t rotors;
  double duration;
  double wave_number;  ///< q of F_s
  Decay scattering;    ///< F_s(q, t)
  Decay orientation;   ///< L_2(t), of a nematic seen from its director; empty without rotors
  std::vector<double> nematic_order;  ///< S at evenly spaced times; empty without rotors
  std::vector<ScalarSeries> series;   ///< others that must not drift: compressibility, energy
  std::vector<HalvesOfCurve>
      halves;  ///< curves of translation that must be the same in both halves
  std::vector<HalvesOfCurve> rotation_halves;  ///< the same of rotation
  DiffusionCoefficient diffusion, rotational_diffusion;
};

/// Whether the order of a run is that of a nematic (order.h): then L_2 is seen from its director, and
/// has a plateau. Never without rotors.
bool is_nematic(const GlassRunData& data);

/// Why orientations are kept, or not.
enum class OrientationKind {
  round,    ///< there are none
  relaxes,  ///< L_2 decays
  ordered,  ///< nematic: L_2 decays to its plateau, and is kept there by order
  lasting,  ///< L_2 does not decay within the run, or not to the plateau: glass, or too short
};

struct GlassRun {
  std::string name;
  double packing_fraction;
  std::uint64_t seed;
  std::size_t rotors;
  double duration;
  double wave_number;      ///< q of τ_α
  Estimate nematic_order;  ///< S
  double plateau;          ///< of L_2, by order; 0 if not nematic
  OrientationKind orientation;
  RelaxationTime translation;  ///< τ_α: F_s(q, t) = 1/e
  RelaxationTime rotation;     ///< τ_2: L_2 = 1/e, in a nematic its connected part
  DiffusionCoefficient diffusion, rotational_diffusion;
  Equilibration equilibration;  ///< of everything
  Equilibration
      translation_equilibration;  ///< of τ_α, `series` and `halves`, whatever rotation does
};

/// Relaxation times, order and verdict of one run.
///
/// In a nematic (order.h) L_2 does not decay to 0 and the mean squared rotation stops although all is in
/// equilibrium. So its connected part is judged, seen from the director (relaxation.h): if that decays
/// below 1/e, and to less than three errors or 0.05 at the longest time, the stop is order; if it does
/// not, orientations last beyond their order. That S is stationary is part of the verdict, as are τ_α
/// and τ_2. Translation has a verdict of its own besides: where orientations stand still, places may
/// still be in equilibrium among them.
GlassRun judge_glass_run(const GlassRunData& data);

/// Adds a judged run to its results: a table `relaxation` of one row, and reasons in the provenance.
void store_glass_run(const GlassRun& run, Results& results);
/// The same from there, with all that a study needs; no value if the results have none. Throws FileError
/// for results of another version.
std::optional<GlassRun> stored_glass_run(const std::string& name, const Results& results);

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

/// Tables `relaxation` (one row per run), `glass_fit` (one row per kind and law) and
/// `glass_fit_windows` (one row per kind, law and window). Kinds, laws and verdicts are numbers there,
/// which the descriptions explain.
std::vector<Table> glass_tables(const GlassStudy& study);
/// What numbers cannot say, as provenance: why runs stay out of the fits, why a law has no φ_c.
std::vector<std::pair<std::string, std::string>> glass_notes(const GlassStudy& study);
/// Times, order and verdict of one run.
nlohmann::ordered_json glass_summary(const GlassRun& run);
/// `fits`: φ_c of every kind and law, or why there is none; `remarks`: order or glass, and what else must be known.
nlohmann::ordered_json glass_summary(const GlassStudy& study);
/// A page for people: densities with order, verdict and times, and where the laws put φ_c.
std::string glass_text(const GlassStudy& study);

}  // namespace vitrel
