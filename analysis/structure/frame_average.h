#pragma once

#include <span>
#include <vector>

/// @file
/// Averages over the frames of a run. Every frame gives a row of numbers.
namespace vitrel {

struct Averages {
  std::vector<double> mean, error;
};

/// Rows x_k of numbers, one from every frame k, each number with a weight w_k.
class FrameAverage {
 public:
  /// Adds the next frame. A row may be longer or shorter than the one before; numbers that are missing or NaN have
  /// weight 0.
  void add(std::span<const double> row, std::span<const double> weights);
  /// Adds the next frame with all weights 1.
  void add(std::span<const double> row);

  /// Returns ⟨w x⟩/⟨w⟩ for every place of the row, NaN where there is no weight. The error is that of a ratio: it is
  /// the error of the slow series (slow_average in blocking.h) w_k (x_k − mean)/⟨w⟩. It is NaN if the frames are too
  /// few, or if `even` is false because they are not evenly spaced in time. `slower` is a slower series that the rows
  /// follow: if it has no error, the errors of the rows are NaN, and otherwise they come from blocks as long as those
  /// of that series.
  Averages averages(bool even, std::span<const double> slower = {}) const;

 private:
  std::vector<std::vector<double>> rows_, weights_;
};

}  // namespace vitrel
