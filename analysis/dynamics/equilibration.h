#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/dynamics/relaxation.h"
#include "analysis/statistics/blocking.h"

/// @file
/// Tests whether a run was in equilibrium, and long enough to tell.
namespace vitrel {

/// A scalar of the run at evenly spaced times, such as compressibility, energy or nematic order.
struct ScalarSeries {
  std::string name;
  std::vector<double> value;
};

/// A correlation or mean square with errors by blocking, as in Correlation.
struct BlockedCurve {
  std::vector<double> time;
  std::vector<double> value;
  std::vector<double> error;        ///< standard error, with Student's factor
  std::vector<std::size_t> blocks;  ///< blocks behind the error; points with 0 are not compared
};

/// One curve from both halves of the run.
struct HalvesOfCurve {
  std::string name;
  BlockedCurve first, second;
};

struct NamedTime {
  std::string name;
  RelaxationTime time;
};

struct RunEvidence {
  double duration;
  std::vector<ScalarSeries> series;
  std::vector<HalvesOfCurve> curves;
  std::vector<NamedTime> times;        ///< times of all that must have relaxed
  bool starts_in_equilibrium = false;  ///< whether the first state was drawn from equilibrium
};

enum class EquilibrationVerdict { equilibrated, ageing, too_short };

struct Equilibration {
  EquilibrationVerdict verdict;
  std::string reason;     ///< what failed first; empty if equilibrated
  std::size_t tests = 0;  ///< number of tests for ageing that could be made
};

/// Returns the verdict of the following tests; the first that fails decides.
///
/// 0. The slowest known time of the run is the longest of the relaxation times and of the correlation times of the
///    series (at which the autocorrelation has fallen to 1/e). What is slow and weak hides in the noise of what is
///    fast, where blocking does not see it. Therefore blocks of a series must be twice as long as that time, and curves
///    are compared at times from half of it on, where their blocks are that long.
/// 1. Drift: the change D over the whole run of a straight line fitted to the series has the error √12 e, where e is
///    the error of the mean of the residuals, by blocking. Where blocking sees no plateau, e comes from eight blocks or
///    more of twice the slowest time, and is widened by what exponential correlations hide. D/(√12 e) is judged as
///    Student's with (blocks − 2) degrees of freedom. Changes below 1e-9 of the value are rounding.
/// 2. Halves: the difference of the curves of both halves in units of its error is Student's with the degrees of
///    freedom of both. It is judged at the longest time at which both have a blocked error, and at shorter ones, each
///    at most half as long as the one before. The run ages if one of the n tests of 1 and 2 has a probability below 1
///    %/n; at most about 1 % of the stationary runs are therefore called ageing (measured: 8 of 600).
/// 3. The run is too short if a relaxation time is not within the measured ones, or none is given; if the duration is
///    below sixteen relaxation times or correlation times of a series, which are eight blocks; or if a series could not
///    be tested for drift. Without any series it is too short if no curve could be compared.
///
/// A run that starts in equilibrium stays there, so its length need not prove it: it is too short only below three
/// relaxation times, or if a relaxation time is not within the measured ones. The tests for ageing are those that can
/// be made.
///
/// "Equilibrated" thus means tested, by the run or by what prepared it. "Ageing" means that the run shows a change;
/// slow change with little statistics is "too short" or passes. A drift of six of its standard errors is found in more
/// than 95 % of the cases.
Equilibration judge_equilibration(const RunEvidence& run);

/// A run must last this many of its relaxation times, which are blocks of two of them each.
inline constexpr double min_relaxations = 2 * min_blocks;
/// A run that starts in equilibrium must last this many of its relaxation times.
inline constexpr double min_relaxations_from_equilibrium = 3;

}  // namespace vitrel
