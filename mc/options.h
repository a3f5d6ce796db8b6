#pragma once

#include <cstdint>
#include <optional>

/// The options of all Monte Carlo stages, without the code that uses them.
namespace vitrel {

enum class Arrangement { square, triangular };

/// Regular positions (lattice.h).
struct LatticeOptions {
  Arrangement arrangement = Arrangement::square;
  double angle = 0;
  bool random_angles = false;  ///< square only: angles uniform in 0 … π instead of `angle`
};

/// Random sequential insertion (insertion.h).
struct InsertionOptions {
  double packing_fraction = 0.3;     ///< to insert at; the box is scaled to it
  std::uint64_t attempts = 1000000;  ///< for one particle, before insertion is called hopeless
  bool aligned = false;              ///< all axes along those of space instead of random ones
};

/// Swelling to a packing fraction by Monte Carlo (swelling.h).
struct SwellingOptions {
  double packing_fraction = 0.7;   ///< to be reached, exactly
  std::uint64_t sweeps = 1000000;  ///< at most
  int threads = 1;                 ///< the result does not depend on it
};

/// How the box changes: both sides by one factor, or one side at a time.
enum class BoxChange { isotropic, anisotropic };

/// Compression at constant pressure (compression.h).
struct CompressionOptions {
  double pressure = 10;  ///< βP
  BoxChange change = BoxChange::isotropic;
  std::optional<double> packing_fraction = {};  ///< ends there, exactly
  std::uint64_t sweeps = 1000;                  ///< ends then; with a packing fraction: gives up
  int threads = 1;
};

/// How particles move: by event chains (event_chain.h), which forget density and places many times sooner
/// and orientations about as fast, or by local trial moves (sampler.h), which can use several threads.
enum class Moves { chains, local };

/// Monte Carlo at constant packing fraction (sampling.h).
struct SamplingOptions {
  std::uint64_t sweeps = 1000;
  Moves moves = Moves::chains;
  double exchanges = 0;  ///< share of the local moves (sampler.h)
  int threads = 1;       ///< of local moves; the result does not depend on it
};

}  // namespace vitrel
