#pragma once

#include <cstdint>
#include <optional>

/// Options of the Monte Carlo stages. They stand apart so that code that reads parameters compiles no algorithm.
namespace vitrel {

enum class Arrangement { square, triangular };

/// square: columns × rows of equal square cells, all particles at `angle`, or each at its own.
/// triangular: the densest packing of disks, stretched along x like the particles; `angle` must
/// be 0. Every particle gets a cell that fits the longest and the widest one; equal particles go up
/// to φ = π/√12 = 0.9069.
/// In both, columns and rows are chosen for few empty sites and for a box close to the given one;
/// then the sides of the box change, at the same area, so that the lattice fits exactly.
struct LatticeOptions {
  Arrangement arrangement = Arrangement::square;
  double angle = 0;
  bool random_angles = false;  ///< square only: angles uniform in 0 … π instead of `angle`
};

/// Random sequential insertion: particles, the largest first, are placed one after another at random positions and
/// orientations where they do not overlap earlier ones, and are never moved.
struct InsertionOptions {
  double packing_fraction = 0.3;     ///< the box is scaled to it
  std::uint64_t attempts = 1000000;  ///< maximum per particle
  bool aligned = false;              ///< all axes along those of space, not random
};

/// Compression by swelling: Monte Carlo to a target packing fraction.
///
/// One round enlarges all particles by a factor g:
///   1. A sweep of trial moves, with step sizes adapted to the density.
///   2. Each particle that is not yet enlarged is enlarged by g if there is space for it.
///   3. Repeat until all are enlarged; if some find no space in 40 sweeps, g − 1 is halved for all.
///   4. Divide all lengths by g: the reference species has a b = 1, so the particles have their old sizes again, and the
///      box is smaller. After a fast_sweeps round the next g is larger.
/// No particle waits for the closest pair of the whole system, so the number of sweeps grows slowly with N. An
/// unsuccessful round (jammed, or stopped) shrinks the box as far as the closest pair allows (shrink_to_contact). The
/// target packing fraction is met to rounding.
struct SwellingOptions {
  double packing_fraction = 0.7;   ///< target, reached exactly
  std::uint64_t sweeps = 1000000;  ///< maximum
  int threads = 1;                 ///< the result does not depend on it
};

/// How the box changes: both sides by one factor, or one side at a time.
enum class BoxChange { isotropic, anisotropic };

/// Compression at constant pressure.
struct CompressionOptions {
  double pressure = 10;  ///< βP
  BoxChange change = BoxChange::isotropic;
  std::optional<double> packing_fraction = {};  ///< target, reached exactly
  std::uint64_t sweeps = 1000;                  ///< number of sweeps; with a target: maximum
  int threads = 1;
};

/// Moves: event chains (event_chain.h), which decorrelate density and positions many times faster and orientations
/// about as fast, or local trial moves (sampler.h), which can use several threads.
enum class Moves { chains, local };

struct SamplingOptions {
  std::uint64_t sweeps = 1000;
  Moves moves = Moves::chains;
  double exchanges = 0;  ///< share of the local moves (sampler.h)
  int threads = 1;       ///< of local moves; the result does not depend on it
};

}  // namespace vitrel
