#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/relaxation.h"

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
  std::vector<NamedTime> times;  ///< all that must have relaxed
};

enum class EquilibrationVerdict { equilibrated, ageing, too_short };

struct Equilibration {
  EquilibrationVerdict verdict;
  std::string reason;  ///< empty if equilibrated; else what failed first
};

/// The verdict, from tests of which the first that fails decides.
///
/// 1. Drift: the change D of a straight line fitted to the series, over the whole run, has the error
///    √12 e, e that of the mean by blocking of what the line leaves. D/(√12 e) is judged as Student's
///    with (blocks − 2) degrees of freedom. Changes below 1e-9 of the value are rounding. A series too
///    short or too slow for blocking is not judged here.
/// 2. Halves: the difference of the curves in units of its error, Student's with the degrees of
///    freedom of both, at the longest time that both have a blocked error at, and at shorter ones, each
///    half as long as the one before or less.
///    Ageing, if one of the n tests of 1 and 2 has a probability below 1 %/n: so much of the stationary
///    runs, or less, is called ageing (measured: 8 of 600).
/// 3. Too short, if the duration is below ten relaxation times or ten correlation times of a series
///    (at which its autocorrelation has fallen to 1/e; of series of six, less than half pass), if a relaxation time is not within the
///    measured ones, or if none is given.
///
/// Ageing means that the run shows a change; slow change with little statistics is "too short" or
/// passes. A drift of six of its standard errors is found in more than 95 % of the cases.
Equilibration judge_equilibration(const RunEvidence& run);

/// A run must last that many of its relaxation times.
inline constexpr double fewest_relaxations = 10;

}  // namespace vitrel
