#pragma once

#include <cstdint>
#include <memory>

#include "core/io/json.h"
#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "edmd/engine.h"

/// @file
/// The simulations of chapter 4 of the thesis (woetzel2012), with its program and with vitrel.
namespace vitrel::bench {

/// N equal particles with a b = 1 in a square box.
struct ThesisScene {
  int particles = 100;
  double aspect_ratio = 2;  ///< 1 for circles
  double packing_fraction = 0.5;
  std::uint64_t seed = 1;
};

/// The largest packing fraction at which equal ellipses at `angle` fit on a square lattice without overlap. For κ =
/// √3 at π/4 it is π/(2√3).
double densest_square_lattice(const Ellipse& shape, double angle);

/// The particles at rest on a square lattice with the major axes along its diagonal, as in the thesis, or on a
/// triangular lattice where the square one does not fit.
Configuration2 on_lattice(const ThesisScene& scene);
/// The particles of the lattice after `duration` units of time of Newtonian dynamics, with new velocities.
Configuration2 equilibrated(const ThesisScene& scene, double duration);

enum class Program {
  ours,      ///< the engine of vitrel
  thesis,    ///< predicts every pair after every event, ellipses by SLSQP as in the thesis
  improved,  ///< keeps a table of the next events of pairs, and checks every answer
};
const char* name_of(Program program);

struct RunLimits {
  double duration = 100;     ///< simulated time
  double seconds = 1e9;      ///< working time of the engine; at least one sample is taken
  double brownian_step = 0;  ///< τ_B, a multiple of the sample interval; 0 for Newtonian dynamics
  std::uint64_t seed = 1;    ///< for the velocities drawn at Brownian steps
};

struct ThesisRun {
  double simulated_time = 0;
  double seconds = 0;  ///< working time of the engine
  RunCounters counters;
  std::uint64_t samples = 0;
  std::uint64_t samples_with_overlap = 0;  ///< by the exact check
  double deepest_overlap = 0;              ///< in units of b
  double energy_drift = 0;                 ///< largest |E − E₀|/E₀ in a Newtonian run
  bool stood_still = false;                ///< endless events at one time
};

/// The columns of a row of a study for this run.
Json run_json(const ThesisRun& run);

std::unique_ptr<Engine2> make_program(Program program, const Configuration2& start);

/// Runs the engine and samples every 0.1 units of time: the exact check, and the energy.
ThesisRun run_thesis(std::unique_ptr<Engine2> engine, const Configuration2& start,
                     const RunLimits& limits, const RunControl& control);

}  // namespace vitrel::bench
