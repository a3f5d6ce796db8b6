#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace vitrel {

/// Returns the arithmetic mean; NaN without values.
double mean_of(std::span<const double> values);

/// A mean and its standard error. The error is widened by Student's factor for the few blocks (or particles) on which
/// it rests, so that mean ± error covers the truth in 68.3 % of the cases. It is NaN if no error can be given.
struct Estimate {
  double mean;
  double error;
  std::size_t blocks;  ///< independent pieces behind the error; 0 if there is no error
};

/// Returns the mean and standard error of a stationary, correlated, evenly sampled series by blocking.
///
/// 1. Neighbouring values are averaged in pairs, again and again: blocks of B = 1, 2, 4 … values. e_B² = variance of
///    the block means / number of blocks. It grows with B until the blocks are longer than the correlations, and then
///    stays on a plateau.
/// 2. The plateau is said to begin at the smallest B with B³ ≥ 2 n max(1, e_B/e_1)⁴, where n is the length of the
///    series. There the bias of e_B² from correlations between blocks equals its statistical scatter, if the
///    correlations have one correlation time. Noise that is forgotten at once can hide a slow part, as in the pressure
///    of a dense liquid; therefore blocks are also so long that fewer than `too_many_blocks` are left. Blocks shorter
///    than `shortest_block` are skipped, for a caller who has a lower bound of the length of the correlations and need
///    not trust chance.
/// 3. At least `min_blocks` blocks must be left on the plateau. This takes some 60 to 180 correlation times, and never
///    fewer than 32 values. Otherwise the series is too short to tell, and the error is NaN.
/// 4. The error is e_B times Student's factor for (blocks − 1) degrees of freedom.
///
/// A constant series has error 0. An empty one has mean NaN. The cost is O(n). Sources: Flyvbjerg & Petersen, J. Chem.
/// Phys. 91, 461 (1989) for 1; Lee, Conduit, Nemec, López Ríos & Drummond, Phys. Rev. E 83, 066706 (2011) for 2.
Estimate block_average(std::span<const double> series, double shortest_block = 1);

/// Returns the mean and its error from blocks of a given length, for a caller who knows the correlations c(s). `seen`
/// is the part of the variance that blocks of B steps show, ∫₀^B (1 − s/B) c(s) ds/∫₀^∞ c(s) ds. The error is NaN for
/// fewer than `min_blocks` blocks. Values left over at the end count for the mean only.
Estimate known_block_average(std::span<const double> series, std::size_t block, double seen = 1);

/// Returns the part that blocks of B steps show of correlations exp(−s/τ), which is 1 − (τ/B)(1 − exp(−B/τ)).
double seen_of_exponential(std::size_t block, double correlation);

/// Returns the number of steps k after which the autocorrelation of a series of n values has fallen to 1/e, or 0 if the
/// series is constant (up to rounding, 1e-9 of the mean). The mean of a short series follows the series, which takes
/// about b = 2k/n off every correlation and the variance, if k is the correlation time; so c(k) + b is compared with
/// (1 + b)/e.
std::size_t correlation_steps(std::span<const double> series);

/// Returns the mean of a series that may be slow. Its error comes from blocking or, if that sees no plateau, from
/// blocks of twice the correlation time of the series itself, for which sixteen correlation times are enough. The error
/// then covers the truth in 64 % of the cases instead of 68 % (measured). No blocks are shorter than `shortest_block`,
/// which serves a series whose noise hides what another series shows to be slow.
Estimate slow_average(std::span<const double> series, std::size_t shortest_block = 1);

/// Blocking of a series that comes value by value and is not kept. For every block length it holds number, mean and
/// variance of the blocks so far, updated as they come [welford1962]. It takes O(log n) memory, and two updates per
/// value on average.
class BlockSums {
 public:
  void add(double value);
  std::size_t count() const;
  Estimate estimate(double shortest_block = 1) const;

  /// Appends its complete state to `numbers`.
  void store(std::vector<double>& numbers) const;
  /// Takes from the front of `numbers` what `store` appended, and returns the rest.
  std::span<const double> restore(std::span<const double> numbers);

 private:
  /// Blocks of 2^k values.
  struct Level {
    double count = 0;
    double mean = 0;
    double squares = 0;  ///< Σ (block − mean)²
    double waiting = 0;  ///< an odd last block, until the one it is paired with arrives
  };
  std::vector<Level> levels_;  ///< levels of which a block is complete
};

/// The fewest blocks on which an error may rest.
inline constexpr std::size_t min_blocks = 8;
/// From this number of blocks on, they are too short for what is slow, and more than an error needs: the error of 16
/// blocks is known to 18 %.
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
/// Differences between the classes, which are not due to chance, thus do not count. The error is NaN for n ≤ K.
Estimate independent_average(std::span<const ValueSums> classes);

/// The mean of n independent values, such as those of several seeds, that may have standard errors of their own.
///
/// 1. Without errors, the variance of a value is estimated by that of the values, s², with n − 1 degrees of freedom.
/// 2. The mean square e² of the errors estimates the same variance if the values differ by chance only. An error counts
///    as known from ten degrees of freedom, so that the combined estimate ((n − 1) s² + 10 n e²)/(11 n − 1) has
///    11 n − 1.
/// 3. If s²/e² is larger than F's distribution allows with a probability of 1 %, the values differ by more than they
///    state: the scatter is excessive, and the estimate of step 1 holds.
struct MeanOfRuns {
  double mean;
  /// s/e; NaN for fewer than two values, or if not all errors are known and above 0.
  double scatter;
  bool is_excessive;
  double squared_error;  ///< squared error of the mean; NaN for fewer than two values
  double degrees_of_freedom;

  /// Returns the half-width of the interval that covers the true mean with the probability `level`: Student's quantile
  /// times the error, exact for normal values.
  double half_width(double level) const;
};
/// Returns the mean of `values`; `errors` holds as many errors, or none.
MeanOfRuns mean_of_runs(std::span<const double> values, std::span<const double> errors = {});

/// Returns the half-width of the central 68.27 % interval of Student's distribution, in units of the standard error:
/// 1 + 1/(2ν) + 1/(4ν²) + 1/(16ν³) − …, the Cornish–Fisher expansion at one standard deviation (Abramowitz & Stegun
/// 26.7.5). The relative error is below 1e-3 for ν ≥ 3 degrees of freedom.
double student_factor(std::size_t degrees_of_freedom);

}  // namespace vitrel
