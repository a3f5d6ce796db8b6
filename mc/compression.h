#pragma once

#include <cstdint>
#include <vector>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/options.h"
#include "mc/sampler.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// The state of the box trials.
struct BoxState {
  StepSize step{0.01};  ///< of ln V
  /// L_y/L_x and L_z/L_x; 0: those of the configuration given.
  double aspect_at_start = 0, depth_at_start = 0;
  std::uint64_t tried = 0, accepted = 0;  ///< since the start
};

/// Monte Carlo of hard ellipses or ellipsoids at constant N, pressure and temperature (Wood, 1968).
///
/// One sweep is two box trials, each of which costs about half as much as a sweep of the Sampler, and such a sweep. In
/// a box trial ln V changes by a uniform amount within ± its step, and all positions scale; shapes and angles do not
/// change. Without overlaps it is accepted with probability
///
///     min(1, exp(−βP (V' − V) + (N + 1) ln(V'/V))),
///
/// which is tested first because it is cheap. anisotropic: one of the sides changes, each with equal probability; a
/// liquid does not resist shear, so the ratio of any two sides stays within a factor `max_aspect_change` of its initial
/// value. Trial k of sweep s draws from the stream (seed, box_trials, s, k): results do not depend on the number of
/// threads. Detailed balance holds for fixed step sizes, which change only in `tune`.
///
/// `pressure` is βP, in units of one over the unit of area (a b of the reference species) or of volume (a b c).
/// Source: wood1968.
template <int Dim>
class PressureSampler {
 public:
  static constexpr double max_aspect_change = 2;
  static constexpr std::uint64_t box_trials = 2;

  /// For the configuration see Sampler.
  PressureSampler(Configuration<Dim>& configuration, double pressure, BoxChange change,
                  std::uint64_t seed, const SweepState& moves = {}, const BoxState& box = {},
                  int threads = 1);

  void sweep();
  /// Adapts all step sizes towards an acceptance of 0.35 (Sampler::tune).
  void tune();

  void set_box_step(double step) { box_.step.size = step; }
  /// The state given at construction, advanced by the work since.
  const SweepState& moves() const { return moves_.state(); }
  const BoxState& box() const { return box_; }

 private:
  void try_box(Stream draw);
  bool change_box(const Vec<Dim>& factors);

  Configuration<Dim>& configuration_;
  double pressure_;
  BoxChange change_;
  std::uint64_t seed_;
  BoxState box_;
  Sampler<Dim> moves_;
};

struct CompressionState {
  SweepState moves;
  BoxState box;
  std::vector<double> packing_fraction;  ///< after every sweep

  void number_sweeps(std::uint64_t next) { moves.next_sweep = next; }
};

/// `reached` at the target packing fraction or, without one, after all sweeps; `stalled` if the sweeps did not suffice or
/// the packing fraction no longer rises: by less than a thousandth from the third to the last quarter of at least 4000
/// sweeps; `stopped` on request between two sweeps: the same call then continues with bit-identical results. Step sizes
/// adapt throughout; without a target only in the first half of the sweeps, so that the second half samples
/// equilibrium. In any case the state is hard. A configuration denser than the target is expanded.
template <int Dim>
StageReport compress(Configuration<Dim>& configuration, const CompressionOptions& options,
                     std::uint64_t seed, CompressionState& state, const RunControl& control);

}  // namespace vitrel
