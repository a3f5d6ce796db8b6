#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace vitrel {

/// Arithmetic mean; NaN without values.
double mean_of(std::span<const double> values);

/// A mean and its standard error. The error is widened by Student's factor for the few blocks (or
/// particles) it rests on, so that mean ± error covers the truth in 68.3 % of the cases; it is NaN
/// where no error can be given.
struct Estimate {
  double mean;
  double error;
  std::size_t blocks;  ///< independent pieces behind the error; 0 if there is no error
};

/// Mean and standard error of a stationary, correlated, evenly sampled series by blocking.
///
/// 1. Neighbouring values are averaged in pairs, again and again: blocks of B = 1, 2, 4 … values.
///    e_B² = variance of the block means / number of blocks. It grows with B until the blocks are
///    longer than the correlations, and then stays on a plateau.
/// 2. The plateau is said to begin at the smallest B with B³ ≥ 2 n max(1, e_B/e_1)⁴: there the bias
///    of e_B² from correlations between blocks equals its statistical scatter (n: length of the
///    series). Blocks shorter than `shortest_block` are passed over: for a caller who knows how
///    long the correlations are at least, and need not trust chance.
/// 3. At least `min_blocks` blocks must be left there: some 60 to 180 correlation times, and never
///    below 32 values. If not, the error is NaN: the series is too short to tell.
/// 4. The error is e_B times Student's factor for (blocks − 1) degrees of freedom.
///
/// A constant series has error 0. An empty one has mean NaN. Cost O(n).
/// Sources: Flyvbjerg & Petersen, J. Chem. Phys. 91, 461 (1989) for 1; Lee, Conduit, Nemec, López
/// Ríos & Drummond, Phys. Rev. E 83, 066706 (2011) for 2.
Estimate block_average(std::span<const double> series, double shortest_block = 1);

/// The same from blocks of a given length B, for a caller who knows the correlations. If these decay
/// exponentially in `correlation` = τ steps, the variance of the block means misses the part
/// (τ/B)(1 − exp(−B/τ)), which is put back. NaN as error for fewer than `min_blocks` blocks; what is
/// left over counts for the mean only.
Estimate known_block_average(std::span<const double> series, std::size_t block,
                             double correlation = 0);

/// The steps k after which the autocorrelation of a series of n values has fallen to 1/e; 0 of a constant
/// (but for rounding, 1e-9 of the mean). The mean of a short series follows the series, which takes
/// about b = 2k/n off every correlation and the variance, if k is the correlation time; so c(k) + b is
/// compared with (1 + b)/e.
std::size_t correlation_steps(std::span<const double> series);

/// Of a series that may be slow: by blocking, or if that sees no plateau, from blocks of twice the
/// correlation time of the series itself, for which sixteen correlation times are enough. The error
/// covers the truth in 64 % of the cases then, instead of 68 (measured).
Estimate slow_average(std::span<const double> series);

/// The same for a series that comes value by value and is not kept: for every block length it holds
/// number, mean and variance of the blocks so far, updated as they come [welford1962]. Memory
/// O(log n); a value costs two updates on the average.
class BlockSums {
 public:
  void add(double value);
  std::size_t count() const;
  Estimate estimate(double shortest_block = 1) const;

  /// Appends all it consists of to `numbers`.
  void store(std::vector<double>& numbers) const;
  /// Takes from the front of `numbers` what `store` appended, and returns the rest.
  std::span<const double> restore(std::span<const double> numbers);

 private:
  /// Blocks of 2^k values.
  struct Level {
    double count = 0;
    double mean = 0;
    double squares = 0;  ///< Σ (block − mean)²
    double waiting = 0;  ///< an odd last block, until the one it is paired with is there
  };
  std::vector<Level> levels_;  ///< those of which a block is complete
};

/// The fewest blocks on which an error may rest.
inline constexpr std::size_t min_blocks = 8;

/// Mean and standard error of independent values, from their number, sum and sum of squares; the
/// error is NaN for fewer than two values.
Estimate independent_average(std::size_t count, double sum, double sum_of_squares);

/// The mean of n ≥ 2 independent values and the half-width t s/√n of the interval that covers the true one with
/// probability `level`: s² is their variance, t Student's quantile for n − 1 degrees of freedom, exact for
/// normal values. NaN for fewer values.
struct ConfidenceInterval {
  double mean, half_width;
};
ConfidenceInterval confidence_interval(std::span<const double> values, double level = 0.95);

/// Half-width of the central 68.27 % interval of Student's distribution, in units of the standard
/// error: 1 + 1/(2ν) + 1/(4ν²) + 1/(16ν³) − …, the Cornish–Fisher expansion at one standard
/// deviation (Abramowitz & Stegun 26.7.5). Relative error below 1e-3 for ν ≥ 3 degrees of freedom.
double student_factor(std::size_t degrees_of_freedom);

}  // namespace vitrel
