#pragma once

#include <cstdint>
#include <optional>
#include <vector>

/// @file
/// Options of the Monte Carlo stages. They stand apart so that code that reads parameters compiles no algorithm.
namespace vitrel {

enum class Arrangement { square, triangular, cubic, face_centred, body_centred };

/// Lattices of equal cells (lattice.h).
struct LatticeOptions {
  Arrangement arrangement = Arrangement::square;
  double angle = 0;
  bool random_angles = false;  ///< square only: angles uniform in 0 … π instead of `angle`
};

/// Random sequential insertion (insertion.h).
struct InsertionOptions {
  double packing_fraction = 0.3;     ///< the box is scaled to it
  std::uint64_t attempts = 1000000;  ///< maximum per particle
  bool aligned = false;              ///< all axes along those of space, not random
  /// ⟨u uᵀ⟩ of the major or figure axes (axis_distribution.h), D × D numbers; empty: isotropic. Around its axis, a body
  /// is turned at random.
  std::vector<double> orientation_tensor = {};
};

/// Compression by swelling (swelling.h).
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

/// Exchanges of places between particles of different sizes (exchanges.h).
struct ExchangeOptions {
  double trials =
      0;  ///< of two particles, per particle and sweep; of local moves, they are this share
  double partners = 1;    ///< closeness of the two: share of all ranks of size, 0 … 1
  double collective = 0;  ///< steps of collective exchanges, per particle and sweep

  bool any() const { return trials > 0 || collective > 0; }
};

struct SamplingOptions {
  std::uint64_t sweeps = 1000;  ///< with a number of decorrelations: maximum
  Moves moves = Moves::chains;
  ExchangeOptions exchanges = {};
  int threads = 1;                   ///< of local moves; the result does not depend on it
  std::uint64_t decorrelations = 0;  ///< (sampling.h); 0: not counted
};

}  // namespace vitrel
