#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "analysis/dynamics/bessel_j0.h"
#include "analysis/dynamics/path.h"
#include "analysis/results.h"
#include "analysis/statistics/blocking.h"
#include "core/state/observer.h"

namespace vitrel {

struct MultipleTauOptions {
  double interval = 0.1;             ///< time between the samples that it is given
  double longest_lag = 100;          ///< maximum time difference
  std::vector<double> wave_numbers;  ///< q of the self-intermediate scattering functions
};

/// The correlations of one group of particles, as columns of a table with one row per lag.
struct CorrelatedGroup {
  std::string name;  ///< "all", or the name of a species
  std::size_t particles = 0;
  /// Particles that are not round; only they have correlations of the angle.
  std::size_t rotors = 0;
  std::vector<Column> columns;
};

/// Computes time correlations of a run while it goes on, without stored frames, over time differences from one sample
/// to the whole run. Its memory grows with the logarithm of the length of the run only:
///
///     msd   ⟨|r(t) − r(0)|²⟩, of unwrapped positions (length²)
///     fs_k  F_s(q_k, t), the average of exp(i q·Δr) over all directions of q
///     msr   ⟨|φ(t) − φ(0)|²⟩, of unwrapped angles or rotation vectors (path.h; rad²), over rotors
///     l_n   in the plane ⟨cos n(θ(t) − θ(0))⟩, n = 2 and 4, over rotors
///     p_n   in space Legendre's ⟨P_n(u(0)·u(t))⟩ of the figure axis, n = 1 and 2, over rotors
///
/// In space msr is left out if a rotor has made about half a turn between two samples (turns_are_known).
///
/// The steps are those of multiple tau with p = `points` places per level, and levels a factor m = 2 apart:
/// 1. Level l keeps the last p of the samples 0, 2^l, 2 · 2^l … Every new one is paired with the older ones of its
///    level: lags j 2^l with j = 1 … p − 1 on level 0, and j = p/2 … p − 1 above, since the level below has the shorter
///    ones. So there are p/2 = 4 lags to a factor of 2 in time, all exact. A lag has 4 to 7 origins in its own time.
///    For diffusion, where the squares from origins s apart are correlated as (1 − s/lag)², the variance is at most 3 %
///    above that of all origins.
/// 2. Every pair of samples gives one mean over the particles of the group. The mean over the pairs is the value; its
///    error is that of their series by blocking on the fly (blocking.h), with blocks of four lags or more as in
///    time_axis.h. It is NaN if the run has fewer than eight such blocks, that is, for lags longer than a 32nd to a
///    64th of it. The spread between particles, which would give an error there, is not kept.
///
/// Samples are thinned from level to level. They are not averaged as for autocorrelations of fluctuating scalars in
/// Ramírez, Sukumaran, Vorselaars & Likhtman, J. Chem. Phys. 133, 154103 (2010) [ramirez2010], whose levels these are.
/// Averages would bias: the mean position over a time w lacks the motion within it, so that diffusion over t gives 2 d
/// D (t − w/3), 8 % too little at the shortest lags of every level, and averaged angles do not determine ⟨cos nΔθ⟩ at
/// all. Thinned samples keep every pair exact.
///
/// Memory, with L = log_2(longest lag/interval) − 1 levels: 5 p L N numbers for the samples (9 in space), that is
/// 320 N L bytes (N = 500, L = 16: 2.6 MB), and about 2 p L log_2(samples) numbers for every correlation and group. A
/// checkpoint holds 3/5 of the numbers for the samples (all in space). A sample costs 11 pairs of samples on the
/// average, which are 11 N evaluations of every correlation. Measured with one wave number, a sample of N = 500 takes
/// about 100 µs, so that a Brownian run of κ = 6 correlated at every step of τ_B = 0.1 takes 9 % longer at φ = 0.60,
/// where a step takes 1.1 ms, and 3 % at 0.72 (2.1 ms). The results depend on nothing but the samples.
template <int Dim>
class MultipleTau final : public Observer<Dim> {
 public:
  static constexpr std::size_t points = 8;

  /// `particles` gives species and shapes, which may not change, nor may the number of particles.
  MultipleTau(const Configuration<Dim>& particles, MultipleTauOptions options);

  /// Takes the samples at 0, interval, 2 interval …
  void observe(const Frame<Dim>& frame) override;

  const MultipleTauOptions& options() const { return options_; }
  std::uint64_t samples() const { return samples_; }

  /// Returns "all" first, then every species that has particles, if there is more than one. The columns are time, the
  /// correlations above and origins, with a row for every lag that has a pair; msr and l_n are there only if there are
  /// rotors.
  std::vector<CorrelatedGroup> correlations() const;

  /// Returns the complete state as numbers for a checkpoint. A correlator made the same way that restores them
  /// continues with bit-identical results.
  std::vector<double> state() const;
  /// Restores a state. Throws UserError if it comes from other particles or options.
  void restore(const std::vector<double>& state);

  /// Returns the bytes that samples take, without the sums.
  static double sample_bytes(std::size_t particles, const MultipleTauOptions& options);

 private:
  static constexpr std::size_t rotations = Path<Dim>::rotations;

  /// A sample of all particles, in the order of `order_`.
  struct Sample {
    std::array<std::vector<double>, Dim> position;
    std::array<std::vector<double>, rotations> turn;
    std::array<std::vector<double>, Dim> axis;

    explicit Sample(std::size_t particles = 0);
  };
  /// The particles of one species, which are neighbours in `order_`, its rotors first.
  struct Range {
    std::size_t begin, rotors_end, end;
  };
  struct Group {
    std::string name;
    std::vector<std::size_t> ranges;
    std::size_t particles = 0, rotors = 0;
  };
  struct LagSums {
    std::size_t steps;            ///< steps between samples of its level
    std::vector<BlockSums> sums;  ///< for every group and every correlation
  };
  struct Level {
    std::vector<Sample> ring;
    std::vector<LagSums> lags;
  };

  void make_groups(const Configuration<Dim>& particles);
  void make_levels();
  // These are msd and fs_k, then msr and two of orientation.
  std::size_t translations() const { return 1 + options_.wave_numbers.size(); }
  std::size_t correlation_count() const { return translations() + 3; }
  /// `shown` is the number of samples that a level has been shown, and `held` the number of those that it holds.
  std::uint64_t shown(std::size_t level) const;
  std::size_t held(std::size_t level) const;

  void take(const Configuration<Dim>& configuration);
  void take_orientation(const Configuration<Dim>& configuration, std::size_t k);
  void set_axis(Sample& sample, std::size_t k) const;
  void restore_orientations(std::span<const double> numbers);
  /// Returns the part of a sample that a state holds.
  template <class AnySample>
  static auto stored(AnySample& sample) {
    std::vector<decltype(sample.position.data())> series;
    for (auto& values : sample.position) series.push_back(&values);
    for (auto& values : sample.turn) series.push_back(&values);
    if constexpr (Dim == 3)
      for (auto& values : sample.axis) series.push_back(&values);
    return series;
  }
  void correlate(const Sample& from, const Sample& to, LagSums& lag);
  void sum_translation(const Sample& from, const Sample& to, const Range& range, double* sums);
  void sum_rotation(const Sample& from, const Sample& to, const Range& range, double* sums) const;
  CorrelatedGroup group_columns(std::size_t group) const;

  MultipleTauOptions options_;
  DirectionAverage<Dim> direction_average_;
  std::vector<std::size_t> order_;  ///< order of the particles: by species, rotors first
  std::vector<Range> ranges_;
  std::vector<Group> groups_;
  std::vector<Level> levels_;
  std::uint64_t samples_ = 0;
  Sample now_;
  std::vector<Quaternion> orientation_;  ///< orientations of the last sample, in space
  double largest_turn_ = 0;              ///< largest turn between two samples, in space
  std::vector<double> square_, sums_;    ///< working space
};

}  // namespace vitrel
