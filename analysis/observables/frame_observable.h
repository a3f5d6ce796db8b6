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

/// The order of one frame after another, as far as it is defined.
struct OrderSeries {
  std::vector<double> nematic, hexatic;
};

template <int Dim>
class FrameObservable {
 public:
  virtual ~FrameObservable() = default;
  /// Measures a frame; may be called for several frames at a time. The function that it returns adds the frame to the
  /// averages, and is called in the order of the frames.
  virtual std::function<void()> measure(const Configuration<Dim>& frame) = 0;
  /// Returns the tables after the last frame. `is_even` says that the frames are equally spaced in time; only then
  /// averages have errors.
  virtual std::vector<Table> tables(bool is_even) const = 0;
  /// Adds the order that this observable knows.
  virtual void add_order(OrderSeries&) const {}
};

/// An observable in the list of all observables: the descriptions of its tables, and the function that makes it, from
/// the first frame, for a run that has what the first of these tables needs.
template <int Dim>
struct FrameObservableType {
  using Make = std::unique_ptr<FrameObservable<Dim>>(const Configuration<Dim>& first,
                                                     const StructureOptions& options);
  std::vector<Observable> tables;
  std::function<Make> make;
};

/// Returns the descriptions of the tables of all observables of frames, in their order.
std::vector<Observable> frame_observables(int dimension);

/// The results from the frames of a run.
struct FrameResults {
  std::vector<Table> tables;
  OrderSeries order;
};

/// Returns the number of frames that averages are taken over. There are fewer for many particles, since a frame of
/// many says more, but at least 64 of those asked for, so that there are errors by blocks in time.
std::size_t frames_for(std::size_t particles, const StructureOptions& options);

/// Reads the frames one after another and measures them on up to `threads` threads, some at a time; the results do not
/// depend on the number of threads. `report` is called with the share of the frames that are done. If `only` is not
/// empty, only observables with a table named in it are measured.
template <int Dim>
FrameResults measure_frames(Trajectory<Dim>& trajectory, const StructureOptions& options,
                            int threads = all_cores, const ProgressReport& report = {},
                            const std::vector<std::string>& only = {});

/// Returns a column with the averages of a row over the frames; `slower` means the same as in FrameAverage.
Column averaged(const std::string& name, const std::string& unit, const FrameAverage& rows,
                bool is_even, std::span<const double> slower = {});

}  // namespace vitrel
