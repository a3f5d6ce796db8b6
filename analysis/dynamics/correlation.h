#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/dynamics/time_axis.h"
#include "analysis/statistics/blocking.h"

/// @file
/// Averages over particles and time origins against the time difference, with their errors.
namespace vitrel {

/// One point of a correlation. `spread` is the standard error if the particles were independent of each other. It comes
/// from the scatter of their own means over the origins among particles that are alike.
struct PointEstimate {
  Estimate by_blocks;  ///< estimate by blocks of time origins; has no error if these are too few
  double spread;
};

/// A function of the time difference.
struct Correlation {
  std::vector<double> value;
  std::vector<double> error;        ///< standard error; NaN if none can be given
  std::vector<std::size_t> blocks;  ///< blocks of time origins behind the error; 0: particles

  /// Adds a point that has an error by blocks or none.
  void push_back(const Estimate& estimate);
  /// Adds the next longer time difference. Where there are no blocks, the error is the spread of the particles, widened
  /// by √(particles that move together). This factor is the quotient of both errors where both are known, at the
  /// sixteen longest time differences of that kind (root mean square), or 1.
  void push_back(const PointEstimate& point);

 private:
  double cooperation() const;
  std::vector<double>
      squared_quotients_;  ///< squared quotients of both errors, where both are known
};

/// Sums of one quantity x_i(k), of particle i from time origin k to a fixed time difference later.
///
/// 1. At every origin x is averaged over the particles; the mean over origins is the value.
/// 2. The error is that of this series of origins by blocking, with blocks of four time differences or more. Where
///    blocking sees no plateau, it comes from blocks of two, which show 7/8 of the variance if origins are correlated
///    as in diffusion. It contains correlations in time and between particles.
/// 3. Where the time difference is too long for eight such blocks, the error comes from the particles (see
///    Correlation), as if the number of them that move together grew no further, which is fair from some thirty
///    relaxation times on. With a single origin they count as independent of each other, and the error is too small by
///    √χ_4 where motion is cooperative. Both include Student's factor. Particles are compared with those of their class
///    only (LikeParticles), because small ones move more than large ones in every run of these particles.
class CorrelationSum {
 public:
  explicit CorrelationSum(std::size_t origins, std::size_t classes = 1)
      : per_origin_(origins), classes_(classes) {}

  /// Adds the values of one particle at consecutive origins, which follow those added before.
  void add(std::size_t first_origin, std::span<const double> values);
  /// Ends a particle, which belongs to this class, and returns its mean over all origins. The next values are those of
  /// another particle.
  double finish_particle(std::size_t its_class = 0);
  /// Adds origin by origin instead: the values of all particles at one origin, which also add to `particle_sums`, the
  /// sums of each particle over the origins.
  void add_origin(std::size_t origin, std::span<const double> values,
                  std::span<double> particle_sums);
  /// Adds these sums after the last origin, with the classes of the particles.
  void finish_particles(std::span<const double> particle_sums,
                        std::span<const std::size_t> classes);
  /// Adds the sums of other particles at the same origins.
  void add(const CorrelationSum& other);

  std::span<const double> per_origin() const { return per_origin_; }
  /// Returns the sums of the origins begin … end − 1 alone, without particles to compare.
  CorrelationSum of_origins(std::size_t begin, std::size_t end) const;
  PointEstimate estimate(const Lag& lag, std::size_t particles) const;
  /// Returns the estimate for an x that decays and is remembered for no longer than the decay takes. Where the time
  /// difference is too long for blocks of four, blocks are as long as the series itself requires (slow_average in
  /// blocking.h).
  PointEstimate estimate_of_decay(const Lag& lag, std::size_t particles) const;
  /// Returns the estimate for an x that is remembered for longer than the time difference: only blocks with a plateau
  /// give an error.
  PointEstimate estimate_with_plateau(const Lag& lag, std::size_t particles) const;

 private:
  friend class MomentSum;

  std::vector<double> per_origin_;  ///< sums over particles
  double particle_ = 0;             ///< sum over the origins of the present particle
  std::vector<ValueSums> classes_;  ///< sums of the particles' means over origins
};

/// Returns the average of a decaying quantity at consecutive origins, as estimate_of_decay does.
Estimate average_of_decay(std::span<const double> series, const Lag& lag);

/// Sums of two quantities of the same particles and origins, and the errors of functions of both means. For the squares
/// s and fourth powers s² of displacements, the ratio shows how far displacements are from being normally distributed:
/// the non-Gaussian parameter is
///
///     α = c ⟨s²⟩/⟨s⟩² − 1, with c = 1/2 in the plane and 1/3 for rotation; 0 for normal distributions.
class MomentSum {
 public:
  explicit MomentSum(std::size_t origins, std::size_t classes = 1)
      : square(origins, classes), quartic(origins, classes), mixed_(classes) {}

  void add(std::size_t first_origin, std::span<const double> squares,
           std::span<const double> fourth_powers);
  void finish_particle(std::size_t its_class = 0);
  void add(const MomentSum& other);

  /// Returns α. Its error is that of the linearised ratio, α + c (x₄ − ⟨s²⟩)/⟨s⟩² − 2 c ⟨s²⟩(x₂ − ⟨s⟩)/⟨s⟩³, as a
  /// CorrelationSum has it: x₂ and x₄ stem from the same origins or particles, and their correlation counts. The bias
  /// of the ratio is that of a sample, −1/n for n independent displacements, while the error is 1/√n. NaN where nothing
  /// moves.
  PointEstimate non_gaussian(double c, const Lag& lag, std::size_t particles) const;
  /// Returns ⟨y⟩/⟨x⟩ of a decaying y and any x > 0, added as squares x and fourth powers y. The error is that of the
  /// linearised ratio (y − x ⟨y⟩/⟨x⟩)/⟨x⟩, as estimate_of_decay has it. NaN if all x are 0.
  PointEstimate ratio(const Lag& lag, std::size_t particles) const;

  CorrelationSum square, quartic;

 private:
  /// Combine both quantities with these factors: at every origin, and as the error if particles are independent.
  std::vector<double> line(double by_quartic, double by_square, std::size_t particles) const;
  double spread(double by_quartic, double by_square) const;

  std::vector<double> mixed_;  ///< Σ (mean of s)(mean of s²) over the particles of every class
};

/// Returns χ = N(⟨Q²⟩ − ⟨Q⟩²) from Q = Σ_i x_i/N at every origin. It is 0 if particles move alike at all times, and the
/// variance of x_i if they are independent. The variance of a sample of correlated origins is too small by the squared
/// error of ⟨Q⟩, which blocking gives and which is added. The error comes from blocking of N(Q − ⟨Q⟩)². Value and error
/// are NaN if there are fewer than eight blocks: fluctuations in time need many independent times.
Estimate susceptibility(const CorrelationSum& sum, const Lag& lag, std::size_t particles);

}  // namespace vitrel
