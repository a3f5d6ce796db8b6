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
///    series), if these have one correlation time. Noise that is forgotten at once can hide a slow part,
///    as in the pressure of a dense liquid; therefore blocks are also so long that fewer than `too_many_blocks`
///    are left. Blocks shorter than `shortest_block` are passed over: for a caller who knows how
///    long the correlations are at least, and need not trust chance.
/// 3. At least `min_blocks` blocks must be left there: some 60 to 180 correlation times, and never
///    below 32 values. If not, the error is NaN: the series is too short to tell.
/// 4. The error is e_B times Student's factor for (blocks − 1) degrees of freedom.
///
/// A constant series has error 0. An empty one has mean NaN. Cost O(n).
/// Sources: Flyvbjerg & Petersen, J. Chem. Phys. 91, 461 (1989) for 1; Lee, Conduit, Nemec, López
/// Ríos & Drummond, Phys. Rev. E 83, 066706 (2011) for 2.
Estimate block_average(std::span<const double> series, double shortest_block = 1);

/// The same from blocks of a given length, for a caller who knows the correlations c(s): `seen` is the part of the
/// variance that blocks of B steps show, ∫₀^B (1 − s/B) c(s) ds/∫₀^∞ c(s) ds. NaN as error for fewer than
/// `min_blocks` blocks; what is left over counts for the mean only.
Estimate known_block_average(std::span<const double> series, std::size_t block, double seen = 1);

/// The part that blocks of B steps show of correlations exp(−s/τ), but for exp(−B/τ): 1 − (τ/B)(1 − exp(−B/τ)).
double seen_of_exponential(std::size_t block, double correlation);

/// The steps k after which the autocorrelation of a series of n values has fallen to 1/e; 0 of a constant
/// (but for rounding, 1e-9 of the mean). The mean of a short series follows the series, which takes
/// about b = 2k/n off every correlation and the variance, if k is the correlation time; so c(k) + b is
/// compared with (1 + b)/e.
std::size_t correlation_steps(std::span<const double> series);

/// The mean of a series that may be slow: by blocking, or if that sees no plateau, from blocks of twice the
/// correlation time of the series itself, for which sixteen correlation times are enough. The error
/// covers the truth in 64 % of the cases then, instead of 68 (measured). No blocks are shorter than `shortest_block`:
/// of a series whose noise hides what another one shows to be slow.
Estimate slow_average(std::span<const double> series, std::size_t shortest_block = 1);

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
/// So many blocks are too short for what is slow, and more than an error needs: that of 16 is known to 18 %.
inline constexpr std::size_t too_many_blocks = 32;

/// Number, sum and sum of squares of values.
struct ValueSums {
  double count = 0, sum = 0, squares = 0;

  void add(double value);
  void add(const ValueSums& other);
};

/// Mean and standard error of n independent values in K classes, such as particles of about the same size:
///
///     error² = Σ (value − mean of its class)²/((n − K) n),
///
/// so that differences between the classes, which are no matter of chance, do not count. NaN as error for n ≤ K.
Estimate independent_average(std::span<const ValueSums> classes);

/// The mean of n independent values, such as those of several seeds, that may have standard errors of their own.
///
/// 1. Without errors the variance of a value is that of the values, s², with n − 1 degrees of freedom.
/// 2. The mean square e² of the errors estimates the same variance if the values differ by chance only. An error
///    counts as known from ten degrees of freedom, so that together ((n − 1) s² + 10 n e²)/(11 n − 1) has 11 n − 1.
/// 3. If s²/e² is larger than F's distribution allows with a probability of 1 %, the values differ by more
///    than they state: the scatter is excessive, and 1 holds.
struct MeanOfRuns {
  double mean;
  double
      scatter;  ///< s/e; NaN for fewer than two values, or if not all errors are known and above 0
  bool is_excessive;
  double squared_error;  ///< of the mean; NaN for fewer than two values
  double degrees_of_freedom;

  /// Half-width of the interval that covers the true mean with this probability: Student's quantile times the error,
  /// exact for normal values.
  double half_width(double level) const;
};
/// As many errors as values, or none.
MeanOfRuns mean_of_runs(std::span<const double> values, std::span<const double> errors = {});

/// Half-width of the central 68.27 % interval of Student's distribution, in units of the standard
/// error: 1 + 1/(2ν) + 1/(4ν²) + 1/(16ν³) − …, the Cornish–Fisher expansion at one standard
/// deviation (Abramowitz & Stegun 26.7.5). Relative error below 1e-3 for ν ≥ 3 degrees of freedom.
double student_factor(std::size_t degrees_of_freedom);

}  // namespace vitrel
