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

/// A function that an analysis calls to report how far it has come; it may be empty.
using ProgressReport = std::function<void(const Progress&)>;

/// The times of the frames of a trajectory, and what is known of the motion between them.
class FrameTimes {
 public:
  virtual ~FrameTimes() = default;
  /// Returns the strictly increasing sample times.
  virtual const std::vector<double>& times() const = 0;
  /// Returns the number up to multiples of which angles in the plane are known: 2π, or π for directors, or 0 if whole
  /// turns are counted.
  virtual double turn_period() const { return 0; }
  /// Returns the frames, in ascending order, before which some particle may have gone another way than its box
  /// crossings say.
  virtual std::vector<std::size_t> doubtful_frames() const { return {}; }
  std::size_t frames() const { return times().size(); }
};

/// A sequence of configurations of the same particles, read one at a time, so that they need not all be in memory.
template <int Dim>
class Trajectory : public FrameTimes {
 public:
  /// Returns frame k; the reference is valid until the next call.
  virtual const Configuration<Dim>& read(std::size_t k) = 0;
  /// Returns frame k for a caller who needs no velocities: they may be those of another frame.
  virtual const Configuration<Dim>& read_places(std::size_t k) { return read(k); }
};

/// A trajectory held in memory.
template <int Dim>
class MemoryTrajectory : public Trajectory<Dim> {
 public:
  /// `frames` are in order of time; each carries its own time.
  explicit MemoryTrajectory(std::vector<Configuration<Dim>> frames) : frames_(std::move(frames)) {
    for (const Configuration<Dim>& frame : frames_) times_.push_back(frame.time);
  }
  const std::vector<double>& times() const override { return times_; }
  const Configuration<Dim>& read(std::size_t k) override { return frames_.at(k); }

 private:
  std::vector<Configuration<Dim>> frames_;
  std::vector<double> times_;
};

/// Frames `begin` … `end` − 1 of another trajectory, which must outlive it.
template <int Dim>
class TrajectoryPart : public Trajectory<Dim> {
 public:
  TrajectoryPart(Trajectory<Dim>& whole, std::size_t begin, std::size_t end)
      : whole_(whole),
        begin_(begin),
        times_(whole.times().begin() + static_cast<std::ptrdiff_t>(begin),
               whole.times().begin() + static_cast<std::ptrdiff_t>(end)) {}
  const std::vector<double>& times() const override { return times_; }
  const Configuration<Dim>& read(std::size_t k) override { return whole_.read(begin_ + k); }
  const Configuration<Dim>& read_places(std::size_t k) override {
    return whole_.read_places(begin_ + k);
  }
  double turn_period() const override { return whole_.turn_period(); }
  std::vector<std::size_t> doubtful_frames() const override {
    std::vector<std::size_t> own;
    for (const std::size_t frame : whole_.doubtful_frames())
      if (frame > begin_ && frame < begin_ + times_.size()) own.push_back(frame - begin_);
    return own;
  }

 private:
  Trajectory<Dim>& whole_;
  std::size_t begin_;
  std::vector<double> times_;
};

using Trajectory2 = Trajectory<2>;
using Trajectory3 = Trajectory<3>;
using MemoryTrajectory2 = MemoryTrajectory<2>;
using MemoryTrajectory3 = MemoryTrajectory<3>;

/// Returns whether the times are equally spaced up to rounding to single precision, in which many programs write them.
/// No time then is farther from its place between the first and the last than 2⁻²³ of the greatest (2⁻²⁴ for its own
/// rounding, and as much for that of the ends), nor than a quarter of the interval. Time differences then depend on the
/// difference of the indices only, and every frame can serve as an origin of time.
bool evenly_spaced(std::span<const double> times);

}  // namespace vitrel
