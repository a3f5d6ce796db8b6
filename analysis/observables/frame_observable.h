#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "analysis/observables/observable.h"
#include "analysis/results.h"
#include "analysis/structure/frame_average.h"
#include "analysis/structure/structure_options.h"
#include "analysis/trajectory.h"
#include "core/parallel.h"

/// @file
/// Quantities of single frames, and their tables. One observable is one source file: it says what is
/// measured in a frame, how frames are averaged, the names, units and sentences of its tables, and how they
/// are drawn.
namespace vitrel {

/// Order of one frame after another, what there is of it.
struct OrderSeries {
  std::vector<double> nematic, hexatic;
};

template <int Dim>
class FrameObservable {
 public:
  virtual ~FrameObservable() = default;
  /// Called for several frames at a time. What it returns adds the frame to the averages, and is called
  /// in the order of the frames.
  virtual std::function<void()> measure(const Configuration<Dim>& frame) = 0;
  /// After the last frame. `is_even`: the frames are equally spaced in time; only then averages have errors.
  virtual std::vector<Table> tables(bool is_even) const = 0;
  /// Adds what it knows of the order.
  virtual void add_order(OrderSeries&) const {}
};

/// An observable as the list of all of them has it: how its tables are described, and how it is made for a
/// run that has what the first of these needs, with the first frame of that.
template <int Dim>
struct FrameObservableType {
  using Make = std::unique_ptr<FrameObservable<Dim>>(const Configuration<Dim>& first,
                                                     const StructureOptions& options);
  std::vector<Observable> tables;
  std::function<Make> make;
};

/// The tables of all observables of frames, in their order.
std::vector<Observable> frame_observables(int dimension);

/// What the frames of a run say.
struct FrameResults {
  std::vector<Table> tables;
  OrderSeries order;
};

/// How many frames averages are taken over: a frame of many particles says more. At least 64 of those that were asked
/// for, for errors by blocks in time.
std::size_t frames_for(std::size_t particles, const StructureOptions& options);

/// Frames are read one after another and measured on up to `threads` threads, some at a time; the results do
/// not depend on it. `report` is called with the share of the frames that are done. Only observables with a
/// table of `only`, if that is not empty.
template <int Dim>
FrameResults measure_frames(Trajectory<Dim>& trajectory, const StructureOptions& options,
                            int threads = all_cores, const ProgressReport& report = {},
                            const std::vector<std::string>& only = {});

/// A column with the averages of a row over the frames; `slower` as FrameAverage has it.
Column averaged(const std::string& name, const std::string& unit, const FrameAverage& rows,
                bool is_even, std::span<const double> slower = {});

}  // namespace vitrel
