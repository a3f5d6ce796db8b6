#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "edmd/engine.h"

/// @file
/// How fast engines are: states to run from, and the clock.
namespace vitrel::bench {

/// Throws InvariantError if a state to measure was not reached.
void must_reach(const StageReport& report);

/// N equal particles with a b = 1 and mass 1 in a square box.
struct FluidScene {
  int particles = 1000;
  double aspect_ratio = 2;  ///< 1: disks
  double packing_fraction = 0.5;
  std::uint64_t seed = 1;
};

/// Inserted at random places and angles at φ = 0.2, swollen to the packing fraction, and mixed by 500
/// sweeps of Monte Carlo; velocities at kT = 1. A liquid, not a melted crystal.
Configuration2 fluid(const FluidScene& scene);

/// The same of N ellipses or ellipsoids of mass 1, in space from φ = 0.1.
template <class Shape>
Configuration<Shape::dimension> liquid(const Shape& shape, int particles, double packing_fraction,
                                       std::uint64_t seed = 1);

/// N disks or spheres of radius 1, inserted at random, with velocities at kT = 1.
template <int Dim>
Configuration<Dim> gas(int particles, double packing_fraction, std::uint64_t seed = 1);

/// Columns × rows copies of a configuration, the particles numbered at random, with velocities of
/// their own. No more a periodic one after some collisions of each.
Configuration2 tiled(const Configuration2& tile, int columns, int rows);

/// The processor time of this process, so that others do not count.
double processor_seconds();

/// What some work of an engine took.
struct Work {
  double seconds = 0;
  double simulated_time = 0;
  RunCounters counters;

  double ns_per_collision() const {
    return 1e9 * seconds / static_cast<double>(counters.collisions);
  }
};

/// An engine at work, for as long as one wants. The time is that of this process, so that others do
/// not count.
template <int Dim>
class TimedRun {
 public:
  TimedRun(std::unique_ptr<Engine<Dim>> engine, Configuration<Dim> start);

  /// Whole blocks, with what their beginning and end takes; at least one, and as many as take so
  /// many seconds.
  Work blocks(double min_seconds);

  const Configuration<Dim>& now() const { return now_; }

 private:
  std::unique_ptr<Engine<Dim>> engine_;
  Configuration<Dim> now_;
};

/// Bytes that this process has allocated now.
std::size_t allocated_bytes();

}  // namespace vitrel::bench
