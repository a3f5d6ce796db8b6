#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "edmd/engine.h"

/// @file
/// The speed of engines: states from which they run, and the clock.
namespace vitrel::bench {

/// Throws InvariantError if a state to be measured was not reached.
void must_reach(const StageReport& report);

/// N equal particles with a b = 1 and mass 1 in a square box.
struct FluidScene {
  int particles = 1000;
  double aspect_ratio = 2;  ///< 1: disks
  double packing_fraction = 0.5;
  std::uint64_t seed = 1;
};

/// A liquid, not a melted crystal: particles are inserted with random places and angles at φ = 0.2, swollen to the
/// packing fraction, and mixed by 500 sweeps of Monte Carlo. Velocities are drawn at kT = 1.
Configuration2 fluid(const FluidScene& scene);

/// A liquid made in the same way from N ellipses or ellipsoids of mass 1; in space insertion is at φ = 0.1.
template <class Shape>
Configuration<Shape::dimension> liquid(const Shape& shape, int particles, double packing_fraction,
                                       std::uint64_t seed = 1);

/// N disks or spheres of radius 1 that are inserted at random, with velocities at kT = 1.
template <int Dim>
Configuration<Dim> gas(int particles, double packing_fraction, std::uint64_t seed = 1);

/// Columns × rows copies of a configuration, with particles numbered at random and with velocities of their own.
/// After some collisions per particle it is no longer periodic.
Configuration2 tiled(const Configuration2& tile, int columns, int rows);

/// The processor time of this process, in which other processes do not count.
double processor_seconds();

/// The work that an engine did.
struct Work {
  double seconds = 0;
  double simulated_time = 0;
  RunCounters counters;

  double ns_per_collision() const {
    return 1e9 * seconds / static_cast<double>(counters.collisions);
  }
};

/// An engine that runs for as long as needed. The time is that of this process, so that other processes do not count.
template <int Dim>
class TimedRun {
 public:
  TimedRun(std::unique_ptr<Engine<Dim>> engine, Configuration<Dim> start);

  /// Runs whole blocks, including their beginning and end: at least one, and enough to take `min_seconds`.
  Work blocks(double min_seconds);

  const Configuration<Dim>& now() const { return now_; }

 private:
  std::unique_ptr<Engine<Dim>> engine_;
  Configuration<Dim> now_;
};

/// The number of bytes that this process has allocated at present.
std::size_t allocated_bytes();

}  // namespace vitrel::bench
