#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/state/configuration.h"
#include "core/state/stage.h"

/// @file
/// Saved runs, as the analysis sees them: a list of sample times and one configuration at each.
namespace vitrel {

/// Whom an analysis tells how far it has come; empty: nobody.
using ProgressReport = std::function<void(const Progress&)>;

/// A sequence of configurations of the same particles, read one at a time: no method of the
/// analysis needs more than one of them in memory at once.
class Trajectory {
 public:
  virtual ~Trajectory() = default;
  /// Strictly increasing sample times.
  virtual const std::vector<double>& times() const = 0;
  /// Frame k; the reference is valid until the next call.
  virtual const Configuration2& read(std::size_t k) = 0;
  std::size_t frames() const { return times().size(); }
};

/// A trajectory held in memory.
class MemoryTrajectory : public Trajectory {
 public:
  /// `frames` in order of time; each carries its own time.
  explicit MemoryTrajectory(std::vector<Configuration2> frames) : frames_(std::move(frames)) {
    for (const Configuration2& frame : frames_) times_.push_back(frame.time);
  }
  const std::vector<double>& times() const override { return times_; }
  const Configuration2& read(std::size_t k) override { return frames_.at(k); }

 private:
  std::vector<Configuration2> frames_;
  std::vector<double> times_;
};

/// Frames `begin` … `end` − 1 of another trajectory, which must outlive it.
class TrajectoryPart : public Trajectory {
 public:
  TrajectoryPart(Trajectory& whole, std::size_t begin, std::size_t end)
      : whole_(whole),
        begin_(begin),
        times_(whole.times().begin() + static_cast<std::ptrdiff_t>(begin),
               whole.times().begin() + static_cast<std::ptrdiff_t>(end)) {}
  const std::vector<double>& times() const override { return times_; }
  const Configuration2& read(std::size_t k) override { return whole_.read(begin_ + k); }

 private:
  Trajectory& whole_;
  std::size_t begin_;
  std::vector<double> times_;
};

/// Whether the times are equally spaced up to rounding to single precision, in which many programs
/// write them: none is farther from its place between the first and the last than 2⁻²³ of the
/// greatest (2⁻²⁴ for its own rounding, as much for that of the ends), nor than a quarter of the
/// interval. Time differences then depend on the difference of the indices only, and every frame can
/// serve as an origin of time.
bool evenly_spaced(std::span<const double> times);

}  // namespace vitrel
