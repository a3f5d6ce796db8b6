#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/dynamics/relaxation.h"
#include "analysis/statistics/blocking.h"

/// @file
/// Whether a run was in equilibrium, and long enough to tell.
namespace vitrel {

/// A scalar of the run at evenly spaced times: compressibility, energy, nematic order.
struct ScalarSeries {
  std::string name;
  std::vector<double> value;
};

/// A correlation or mean square with errors by blocking, as the structs of analysis give them.
struct BlockedCurve {
  std::vector<double> time;
  std::vector<double> value;
  std::vector<double> error;        ///< with Student's factor
  std::vector<std::size_t> blocks;  ///< behind the error; 0: none, such points are not compared
};

/// The same curve from both halves of the run.
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
  std::vector<NamedTime> times;        ///< all that must have relaxed
  bool starts_in_equilibrium = false;  ///< its first state was drawn from equilibrium
};

enum class EquilibrationVerdict { equilibrated, ageing, too_short };

struct Equilibration {
  EquilibrationVerdict verdict;
  std::string reason;     ///< empty if equilibrated; else what failed first
  std::size_t tests = 0;  ///< for ageing that could be made
};

/// The verdict, from tests of which the first that fails decides.
///
/// 0. The slowest known time of the run: the longest of the relaxation times and of the correlation
///    times of the series (at which the autocorrelation has fallen to 1/e). What is slow and weak hides
///    in the noise of what is fast, where blocking does not see it: so blocks of a series must be twice
///    that long, and curves are compared at times from half of it on, where their blocks are.
/// 1. Drift: the change D of a straight line fitted to the series, over the whole run, has the error
///    √12 e, e that of the mean by blocking of what the line leaves; where blocking sees no plateau, by
///    eight blocks or more of twice the slowest time, widened by what exponential correlations hide.
///    D/(√12 e) is judged as Student's with (blocks − 2) degrees of freedom. Changes below 1e-9 of the
///    value are rounding.
/// 2. Halves: the difference of the curves in units of its error, Student's with the degrees of
///    freedom of both, at the longest time that both have a blocked error at, and at shorter ones, each
///    half as long as the one before or less.
///    Ageing, if one of the n tests of 1 and 2 has a probability below 1 %/n: so much of the stationary
///    runs, or less, is called ageing (measured: 8 of 600).
/// 3. Too short, if a relaxation time is not within the measured ones, or none is given; if the
///    duration is below sixteen relaxation times or correlation times of a series, which are eight
///    blocks; or if a series could not be tested for drift. Without any series, if no curve could be
///    compared.
///
/// A run that starts in equilibrium stays there, so its length need not tell: it is too short only below three relaxation
/// times, or if one is not within the measured ones. The tests for ageing are those that can be made.
///
/// So equilibrated means tested, by the run or by what prepared it. Ageing means that the run shows a change; slow
/// change with little statistics is "too short" or passes. A drift of six of its standard errors is found in more than
/// 95 % of the cases.
Equilibration judge_equilibration(const RunEvidence& run);

/// A run must last that many of its relaxation times: blocks of two of them each.
inline constexpr double min_relaxations = 2 * min_blocks;
/// The same of a run that starts in equilibrium.
inline constexpr double min_relaxations_from_equilibrium = 3;

}  // namespace vitrel
