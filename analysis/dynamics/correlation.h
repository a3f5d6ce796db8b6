#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/dynamics/time_axis.h"
#include "analysis/statistics/blocking.h"

/// @file
/// Averages over particles and time origins against the time difference, with their errors.
namespace vitrel {

/// One point of a correlation. `spread` is the standard error if the particles were independent of each
/// other, from the scatter of their own means over the origins among particles that are alike.
struct PointEstimate {
  Estimate by_blocks;  ///< of time origins; without an error where these are too few
  double spread;
};

/// A function of the time difference.
struct Correlation {
  std::vector<double> value;
  std::vector<double> error;        ///< standard error; NaN where none can be given
  std::vector<std::size_t> blocks;  ///< of time origins behind the error; 0: particles

  /// With the error by blocks, and no other.
  void push_back(const Estimate& estimate);
  /// The next longer time difference. Where there are no blocks the error is the spread of the
  /// particles, widened by √(particles that move together): the quotient of both errors where both
  /// are known, at the sixteen longest time differences of that kind (root mean square), or 1.
  void push_back(const PointEstimate& point);

 private:
  double cooperation() const;
  std::vector<double> squared_quotients_;  ///< of both errors, where both are known
};

/// Sums of one quantity x_i(k), of particle i from time origin k to a fixed time difference later.
///
/// 1. At every origin x is averaged over the particles; the mean over origins is the value.
/// 2. The error is that of this series of origins by blocking, with blocks of four time differences
///    or more; where blocking sees no plateau, from blocks of two, which show 7/8 of the variance if origins are
///    correlated as in diffusion. It sees correlations in time and between particles.
/// 3. Where the time difference is too long for eight such blocks the particles stand in for them
///    (see Correlation), as if it grew no further how many of them move together: fair from some
///    thirty relaxation times on. With a single origin they count as independent of each other, and
///    the error is too small by √χ_4 where motion is cooperative. Both include Student's factor.
///    Particles are compared with those of their class only (LikeParticles): small ones move more
///    than large ones in every run of these particles.
class CorrelationSum {
 public:
  explicit CorrelationSum(std::size_t origins, std::size_t classes = 1)
      : per_origin_(origins), classes_(classes) {}

  /// The values of one particle at consecutive origins, the next ones of that particle.
  void add(std::size_t first_origin, std::span<const double> values);
  /// Its mean over all origins; it belongs to that class. The next values are those of another particle.
  double finish_particle(std::size_t its_class = 0);
  /// Else, origin by origin: the values of all particles at one, which also add to their own sums over the origins …
  void add_origin(std::size_t origin, std::span<const double> values,
                  std::span<double> particle_sums);
  /// … and at last these sums, with the classes of the particles.
  void finish_particles(std::span<const double> particle_sums,
                        std::span<const std::size_t> classes);
  /// The sums of other particles at the same origins.
  void add(const CorrelationSum& other);

  std::span<const double> per_origin() const { return per_origin_; }
  /// The same of the origins begin … end − 1 alone, without particles to compare.
  CorrelationSum of_origins(std::size_t begin, std::size_t end) const;
  PointEstimate estimate(const Lag& lag, std::size_t particles) const;
  /// The estimate for an x that decays and is remembered for no longer than that takes: where the time difference is
  /// too long for blocks of four, these are as long as the series itself asks for (slow_average in blocking.h).
  PointEstimate estimate_of_decay(const Lag& lag, std::size_t particles) const;
  /// The estimate for an x that is remembered for longer than the time difference: blocks with a plateau only.
  PointEstimate estimate_with_plateau(const Lag& lag, std::size_t particles) const;

 private:
  friend class MomentSum;

  std::vector<double> per_origin_;  ///< summed over particles
  double particle_ = 0;             ///< sum over the origins of the present particle
  std::vector<ValueSums> classes_;  ///< of the particles' means over origins
};

/// A decaying quantity at consecutive origins, averaged as estimate_of_decay does.
Estimate average_of_decay(std::span<const double> series, const Lag& lag);

/// Sums of two quantities of the same particles and origins, and the errors of functions of both means. Of the squares
/// s and fourth powers s² of displacements the ratio shows how far they are from being normally distributed: the
/// non-Gaussian parameter
///
///     α = c ⟨s²⟩/⟨s⟩² − 1, c = 1/2 in the plane, 1/3 for rotation; 0 for normal distributions.
class MomentSum {
 public:
  explicit MomentSum(std::size_t origins, std::size_t classes = 1)
      : square(origins, classes), quartic(origins, classes), mixed_(classes) {}

  void add(std::size_t first_origin, std::span<const double> squares,
           std::span<const double> fourth_powers);
  void finish_particle(std::size_t its_class = 0);
  void add(const MomentSum& other);

  /// Its error is that of the linearised ratio, α + c (x₄ − ⟨s²⟩)/⟨s⟩² − 2 c ⟨s²⟩(x₂ − ⟨s⟩)/⟨s⟩³,
  /// as a CorrelationSum has it: x₂ and x₄ stem from the same origins or particles, and their
  /// correlation counts. The bias from the ratio is that of a sample, −1/n of n independent
  /// displacements; the error is 1/√n. NaN where nothing moves.
  PointEstimate non_gaussian(double c, const Lag& lag, std::size_t particles) const;
  /// ⟨y⟩/⟨x⟩ of a decaying y and any x > 0, added as squares x and fourth powers y. The error is that of the
  /// linearised ratio (y − x ⟨y⟩/⟨x⟩)/⟨x⟩, as estimate_of_decay has it. NaN if all x are 0.
  PointEstimate ratio(const Lag& lag, std::size_t particles) const;

  CorrelationSum square, quartic;

 private:
  /// The combination of both quantities with these factors: at every origin, and its error if particles are
  /// independent.
  std::vector<double> line(double by_quartic, double by_square, std::size_t particles) const;
  double spread(double by_quartic, double by_square) const;

  std::vector<double> mixed_;  ///< Σ (mean of s)(mean of s²) over the particles of every class
};

/// χ = N(⟨Q²⟩ − ⟨Q⟩²) from Q = Σ_i x_i/N at every origin: 0 if particles move alike at all times,
/// the variance of x_i if they are independent. The variance of a sample of correlated origins is
/// too small by the squared error of ⟨Q⟩, which blocking gives and which is added. Error by blocking
/// of N(Q − ⟨Q⟩)². Value and error are NaN where there are fewer than eight blocks: fluctuations in
/// time need many independent times.
Estimate susceptibility(const CorrelationSum& sum, const Lag& lag, std::size_t particles);

}  // namespace vitrel
