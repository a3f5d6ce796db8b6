#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/dynamics/diffusion.h"
#include "analysis/dynamics/equilibration.h"
#include "analysis/dynamics/relaxation.h"
#include "analysis/statistics/blocking.h"

/// @file
/// Finds out whether the particles of one run move and turn, and how fast.
namespace vitrel {

/// The data of one run that its analysis hands over.
struct GlassRunData {
  std::string name;
  int dimension = 2;
  double packing_fraction;
  std::uint64_t seed;
  std::size_t rotors;
  double duration;
  bool starts_in_equilibrium;  ///< whether the first state was drawn from equilibrium
  double wave_number;          ///< q of F_s
  Decay scattering;  ///< F_s(q, t), in the plane relative to the cage if that was measured
  bool relative_to_cage = false;  ///< whether `scattering` is
  Decay orientation;  ///< L_2(t), for a nematic seen from its director; empty without rotors
  std::vector<double> nematic_order;  ///< S at evenly spaced times; empty without rotors
  std::vector<ScalarSeries> series;   ///< other series that must not drift: compressibility, energy
  /// Curves of translation that must be the same in both halves.
  std::vector<HalvesOfCurve> halves;
  std::vector<HalvesOfCurve> rotation_halves;  ///< curves of rotation that must be likewise
  DiffusionCoefficient diffusion, rotational_diffusion;
};

/// Returns whether the order of a run is that of a nematic (order.h): L_2 is then seen from its director, and has a
/// plateau. A run without rotors is never nematic.
bool is_nematic(const GlassRunData& data);

/// Whether orientations persist, and why.
enum class OrientationKind {
  round,    ///< there are no orientations
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
  double wave_number;        ///< q of τ_α
  Estimate nematic_order;    ///< S
  double nematic_by_chance;  ///< S of as many random axes; NaN without rotors
  double plateau;            ///< plateau of L_2, by order; 0 if not nematic
  OrientationKind orientation;
  bool relative_to_cage;  ///< whether τ_α is relative to it, as in the plane (cage_relative.h)
  RelaxationTime translation;  ///< τ_α: F_s(q, t) = 1/e
  RelaxationTime rotation;     ///< τ_2: L_2 = 1/e, in a nematic its connected part
  DiffusionCoefficient diffusion, rotational_diffusion;
  Equilibration equilibration;  ///< verdict on everything
  /// Verdict on τ_α, `series` and `halves`, whatever rotation does.
  Equilibration translation_equilibration;
};

/// Returns the relaxation times, the order and the verdicts of one run.
///
/// In a nematic (order.h) L_2 does not decay to 0, and the mean squared rotation stops although all is in equilibrium.
/// Therefore the connected part of L_2 is judged, seen from the director (relaxation.h). If it decays below 1/e, and to
/// less than three errors or 0.05 at the longest time, order is the reason why L_2 stops decaying; if it does not,
/// orientations last beyond their order. Stationary S is part of the verdict, and so are τ_α and τ_2. Translation has a
/// verdict of its own besides: where orientations stand still, places may still be in equilibrium among them.
///
/// In the plane τ_α is that of the motion relative to the cage. Long waves make F_s itself decay earlier, by a factor
/// of thirty at the highest densities of docs/glass.md, and blocks of that shorter time are not independent.
GlassRun judge_glass_run(const GlassRunData& data);

/// Keeps the two verdicts from contradicting each other and τ_α. A run in equilibrium altogether is in equilibrium in
/// its translation: the tests of everything contain those of translation, with blocks of the slowest motion. A run
/// shorter than three times its τ_α is too short. Results of older versions may say otherwise, because these judged by
/// F_s itself in the plane.
void reconcile_verdicts(GlassRun& run);

/// Returns whether the verdict is `equilibrated`.
bool equilibrated(const Equilibration& equilibration);

}  // namespace vitrel
