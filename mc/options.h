#pragma once

#include <cstdint>
#include <optional>
#include <vector>

/// @file
/// Options of the Monte Carlo stages. They stand apart so that code that reads parameters compiles no algorithm.
namespace vitrel {

enum class Arrangement { square, triangular, cubic, face_centred, body_centred };

/// Options of lattices of equal cells (lattice.h).
struct LatticeOptions {
  Arrangement arrangement = Arrangement::square;
  double angle = 0;
  bool random_angles = false;  ///< square only: angles uniform in 0 … π instead of `angle`
};

/// Options of random sequential insertion (insertion.h).
struct InsertionOptions {
  double packing_fraction = 0.3;     ///< the box is scaled to it
  std::uint64_t attempts = 1000000;  ///< maximum number per particle
  bool aligned = false;              ///< puts all axes along those of space, not at random
  /// ⟨u uᵀ⟩ of the major or figure axes (axis_distribution.h) as D × D numbers; empty: isotropic. Each body is turned
  /// about its axis at random.
  std::vector<double> orientation_tensor = {};
};

/// Options of compression by swelling (swelling.h).
struct SwellingOptions {
  double packing_fraction = 0.7;   ///< target, reached exactly
  std::uint64_t sweeps = 1000000;  ///< maximum number
  int threads = 1;                 ///< the result does not depend on it
};

/// How the box changes: all sides by one factor, or one side at a time.
enum class BoxChange { isotropic, anisotropic };

/// Options of compression at constant pressure.
struct CompressionOptions {
  double pressure = 10;  ///< βP
  BoxChange change = BoxChange::isotropic;
  std::optional<double> packing_fraction = {};  ///< target, reached exactly
  std::uint64_t sweeps = 1000;                  ///< number of sweeps; with a target: maximum
  int threads = 1;
};

/// The kind of moves: event chains (event_chain.h), which decorrelate density and positions many times faster and
/// orientations about as fast, or local trial moves (sampler.h), which can use several threads.
enum class Moves { chains, local };

/// Options of exchanges of places between particles of different sizes (exchanges.h).
struct ExchangeOptions {
  /// Trials with two particles, per particle and sweep; with local moves, the share of all trials.
  double trials = 0;
  /// Maximum difference of the two in rank of size, as a share of all ranks, 0 … 1.
  double partners = 1;
  double collective = 0;  ///< steps of collective exchanges, per particle and sweep

  bool any() const { return trials > 0 || collective > 0; }
};

struct SamplingOptions {
  std::uint64_t sweeps = 1000;  ///< number of sweeps; if decorrelations are counted: maximum
  Moves moves = Moves::chains;
  ExchangeOptions exchanges = {};
  int threads = 1;                   ///< for local moves; the result does not depend on it
  std::uint64_t decorrelations = 0;  ///< number to reach (sampling.h); 0: not counted
};

}  // namespace vitrel
