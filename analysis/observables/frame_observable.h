#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "analysis/results.h"
#include "analysis/structure/frame_average.h"
#include "analysis/structure/structure_options.h"
#include "analysis/trajectory.h"
#include "core/parallel.h"

/// @file
/// Quantities of single frames, and their tables. One observable is one source file: it says what is
/// measured in a frame, how frames are averaged, and the names, units and sentences of its tables.
namespace vitrel {

template <int Dim>
class FrameObservable {
 public:
  virtual ~FrameObservable() = default;
  /// Called for several frames at a time. What it returns adds the frame to the averages, and is called
  /// in the order of the frames.
  virtual std::function<void()> measure(const Configuration<Dim>& frame) = 0;
  /// After the last frame. `is_even`: the frames are equally spaced in time; only then averages have errors.
  virtual std::vector<Table> tables(bool is_even) const = 0;
};

template <int Dim>
using FrameObservables = std::vector<std::unique_ptr<FrameObservable<Dim>>>;

/// All observables that the particles of `first`, the first frame, have: the list to add to.
template <int Dim>
FrameObservables<Dim> frame_observables(const Configuration<Dim>& first,
                                        const StructureOptions& options);

/// Their tables, in this order. Frames are read one after another and measured on up to `threads`
/// threads, some at a time; the results do not depend on it. `report` is called with the share of the
/// frames that are done.
template <int Dim>
std::vector<Table> structure_tables(Trajectory<Dim>& trajectory, const StructureOptions& options,
                                    int threads = all_cores, const ProgressReport& report = {});

/// A column with the averages of a row over the frames.
Column averaged(const std::string& name, const std::string& unit, const FrameAverage& rows,
                bool is_even);

// One source file each.
template <int Dim>
std::unique_ptr<FrameObservable<Dim>> structure_factor_observable(const Configuration<Dim>& first,
                                                                  const ShellOptions& options);
template <int Dim>
std::unique_ptr<FrameObservable<Dim>> pair_correlation_observable(
    const Configuration<Dim>& first, const PairCorrelationOptions& options);
/// Of particles that are not round.
template <int Dim>
std::unique_ptr<FrameObservable<Dim>> orientation_observable(const Configuration<Dim>& first);
template <int Dim>
std::unique_ptr<FrameObservable<Dim>> order_observable(const Configuration<Dim>& first);
/// Of particles that move.
template <int Dim>
std::unique_ptr<FrameObservable<Dim>> velocity_observable();

}  // namespace vitrel
