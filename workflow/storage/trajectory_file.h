#pragma once

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "analysis/dynamics/energy.h"
#include "analysis/trajectory.h"
#include "core/io/h5md.h"
#include "core/state/observer.h"

/// @file
/// The file of a run: what the program writes with every frame, and how the analysis reads it.
namespace vitrel {

/// The names of the observables that `run` stores with every frame: totals over all particles, and totals since the
/// start of the run. Helfand moments are among them only if momentum and energy are conserved.
std::vector<std::string> run_observables(int dimension, bool is_conservative);
/// Measures the observables that are in `names`.
template <int Dim>
Observables measure_run(const Frame<Dim>& frame, const std::vector<std::string>& names);

/// A trajectory file of this dimension as a Trajectory for the analysis.
template <int Dim>
class TrajectoryFile final : public Trajectory<Dim> {
 public:
  explicit TrajectoryFile(TrajectoryReader reader) : reader_(std::move(reader)) {
    reader_.require_dimension(Dim);
  }
  const std::vector<double>& times() const override { return reader_.times(); }
  const Configuration<Dim>& read(std::size_t k) override {
    reader_.read(k, frame_);
    return frame_;
  }
  const Configuration<Dim>& read_places(std::size_t k) override {
    reader_.read_places(k, frame_);
    return frame_;
  }
  double turn_period() const override {
    if (reader_.angles_are_directors()) return std::numbers::pi;
    return reader_.has("angle") ? 0 : 2 * std::numbers::pi;
  }
  std::vector<std::size_t> doubtful_frames() const override { return reader_.doubtful_frames(); }
  const TrajectoryReader& reader() const { return reader_; }

 private:
  TrajectoryReader reader_;
  Configuration<Dim> frame_;
};

/// Energies per particle from the stored observables; empty if the file has none.
EnergySeries observed_energies(const TrajectoryReader& reader);

/// Without values if the file has no energies or no virial.
CompressibilitySeries stored_compressibility(const TrajectoryReader& reader,
                                             const EnergySeries& energy, std::size_t rotations);

/// The Helfand moments of all frames, one array for each element; empty if the file has none.
std::vector<std::vector<double>> helfand_moments(const TrajectoryReader& reader);

}  // namespace vitrel
