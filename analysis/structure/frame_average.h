#pragma once

#include <span>
#include <vector>

/// @file
/// Averages over the frames of a run of what is measured in each: a row of numbers.
namespace vitrel {

struct Averages {
  std::vector<double> mean, error;
};

/// Rows x_k of numbers, one from every frame k, each number with a weight w_k.
class FrameAverage {
 public:
  /// The next frame. A row may be longer or shorter than the one before; what is missing has weight 0,
  /// as has what is not a number.
  void add(std::span<const double> row, std::span<const double> weights);
  /// All with weight 1.
  void add(std::span<const double> row);

  /// ⟨w x⟩/⟨w⟩ for every place of the row, NaN where there is no weight. The error is that of a
  /// ratio: that of a slow series (slow_average in blocking.h), w_k (x_k − mean)/⟨w⟩. It is NaN if the frames are
  /// not evenly spaced in time, `even` then being false, or too few. Of what follows a slower series it is NaN if that
  /// has no error, and else from blocks as long as those of that series.
  Averages averages(bool even, std::span<const double> slower = {}) const;

 private:
  std::vector<std::vector<double>> rows_, weights_;
};

}  // namespace vitrel
