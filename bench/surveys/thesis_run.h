#pragma once

#include <cstdint>
#include <memory>

#include "core/io/json.h"
#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "edmd/engine.h"

/// @file
/// The simulations of chapter 4 of the thesis (woetzel2012), with its program and with this one.
namespace vitrel::bench {

/// N equal particles with a b = 1 in a square box.
struct ThesisScene {
  int particles = 100;
  double aspect_ratio = 2;  ///< 1: circles
  double packing_fraction = 0.5;
  std::uint64_t seed = 1;
};

/// The largest packing fraction at which equal ellipses at `angle` fit a square lattice without
/// overlap; κ = √3 at π/4 reaches π/(2√3).
double densest_square_lattice(const Ellipse& shape, double angle);

/// On a square lattice with the major axes along its diagonal, as in the thesis, or triangular where
/// that does not fit; at rest.
Configuration2 on_lattice(const ThesisScene& scene);
/// The same after `duration` units of time of Newtonian dynamics, and with new velocities.
Configuration2 equilibrated(const ThesisScene& scene, double duration);

enum class Program {
  ours,      ///< the engine
  thesis,    ///< every pair asked after every event, ellipses by SLSQP as the thesis has it
  improved,  ///< the same with a table of the pairs' next events, and every answer checked
};
const char* name_of(Program program);

struct RunLimits {
  double duration = 100;     ///< simulated
  double seconds = 1e9;      ///< that the engine works; at least one sample is taken
  double brownian_step = 0;  ///< τ_B, a multiple of the sample interval; 0: Newtonian
  std::uint64_t seed = 1;    ///< of the velocities drawn at Brownian steps
};

struct ThesisRun {
  double simulated_time = 0;
  double seconds = 0;  ///< that the engine worked
  RunCounters counters;
  std::uint64_t samples = 0;
  std::uint64_t samples_with_overlap = 0;  ///< by the exact check
  double deepest_overlap = 0;              ///< in units of b
  double energy_drift = 0;                 ///< largest |E − E₀|/E₀ of a Newtonian run
  bool stood_still = false;                ///< events without end at one time
};

/// What a row of a study says of it.
Json run_json(const ThesisRun& run);

std::unique_ptr<Engine2> make_program(Program program, const Configuration2& start);

/// Samples every 0.1 units of time: the exact check, and the energy.
ThesisRun run_thesis(std::unique_ptr<Engine2> engine, const Configuration2& start,
                     const RunLimits& limits, const RunControl& control);

}  // namespace vitrel::bench
