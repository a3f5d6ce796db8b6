#pragma once

#include <cstdint>
#include <optional>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/sampler.h"

namespace vitrel {

/// How the box changes: both sides by one factor, or one side at a time.
enum class BoxChange { isotropic, anisotropic };

/// Monte Carlo of hard ellipses at constant N, pressure and temperature (Wood, 1968).
///
/// One sweep is a sweep of the Sampler and one trial of the box: ln V changes by a uniform amount
/// within ± `box_step`, all positions with it, shapes and angles not. Without overlaps it is accepted
/// with probability
///     min(1, exp(−βP (V' − V) + (N + 1) ln(V'/V))),
/// the cheap factor first. anisotropic: by one of the two sides, each with probability 1/2; a liquid
/// does not resist shear, so L_y/L_x is kept within a factor `widest_change` of that at the start. The
/// trial of sweep s draws from the stream (seed, box_trials, s): results do not depend on the number of
/// threads. Detailed balance holds for fixed step sizes; they change only in `tune`.
///
/// `pressure` is βP, in units of one over the unit of area (a b of the reference species).
/// Source: wood1968.
class PressureSampler {
 public:
  static constexpr double widest_change = 2;

  /// For the configuration see Sampler.
  PressureSampler(Configuration2& configuration, double pressure, BoxChange change,
                  std::uint64_t seed, std::uint64_t first_sweep = 0, int threads = 1);

  void sweep();
  /// Adapts all step sizes towards an acceptance of 0.35 (Sampler::tune).
  void tune();

  double box_step() const { return box_step_.size(); }
  void set_box_step(double step) { box_step_.set(step); }
  /// The moves of the particles.
  Sampler& moves() { return moves_; }
  std::uint64_t box_trials() const { return tried_; }
  std::uint64_t box_changes() const { return accepted_; }

 private:
  void try_box(Stream draw);

  Configuration2& configuration_;
  double pressure_;
  BoxChange change_;
  std::uint64_t seed_;
  double aspect_at_start_;
  Sampler moves_;
  StepSize box_step_{0.01};
  std::uint64_t tried_ = 0, accepted_ = 0;
};

/// Compression at constant pressure.
struct CompressionOptions {
  double pressure = 10;  ///< βP
  BoxChange change = BoxChange::isotropic;
  std::optional<double> packing_fraction = {};  ///< ends there, exactly
  std::uint64_t sweeps = 1000;                  ///< ends then; with a packing fraction: gives up
  int threads = 1;
};

/// The packing fraction of a compression, averaged over the second half of its sweeps, and their number.
struct CompressionReport : StageReport {
  double packing_fraction = 0;
  std::uint64_t sweeps = 0;
};

/// `reached` at the wanted packing fraction or, without one, after all sweeps; `stuck` if the sweeps
/// did not suffice or if the packing fraction no longer rises: by less than a thousandth from the
/// third to the last quarter of what has been done, and that 4000 sweeps or more; `stopped` by the
/// budget. Step sizes adapt all the way. In any case the state is hard. Sweeps are numbered from
/// `first_sweep`, which returns as the next one. A configuration denser than wanted is expanded.
CompressionReport compress(Configuration2& configuration, const CompressionOptions& options,
                           std::uint64_t seed, std::uint64_t& first_sweep, const Budget& budget);

}  // namespace vitrel
