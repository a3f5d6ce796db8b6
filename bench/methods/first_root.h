#pragma once

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "bench/methods/bracket.h"

namespace vitrel::bench {

/// The root of f between `low`, where f > 0, and `high`, where f ≤ 0, to double precision. It uses algorithm 748 of
/// Alefeld, Potra and Shi with a bound on the number of evaluations.
template <class Function>
double root_between(Function&& f, double low, double f_low, double high, double f_high) {
  if (!(f_low > 0) || !(f_high < 0)) return f_high <= 0 && f_low > 0 ? high : low;
  const auto close = [](double a, double b) {
    return b - a <= 2 * std::numeric_limits<double>::epsilon() * b;
  };
  using namespace boost::math::policies;
  using Silent = policy<domain_error<errno_on_error>, evaluation_error<errno_on_error>>;
  std::uintmax_t evaluations = 200;
  const auto [a, b] =
      boost::math::tools::toms748_solve(f, low, high, f_low, f_high, close, evaluations, Silent{});
  return 0.5 * (a + b);
}

/// The number of steps if each is this fraction of the whole.
inline int scan_steps_of(double fraction) {
  constexpr double max_steps = 1e6;
  return static_cast<int>(std::clamp(std::ceil(1 / fraction), 1.0, max_steps));
}

struct RootSearch {
  std::optional<double> time;  ///< of the first change of sign that the scan found
  int evaluations = 0;
};

/// Finds the first change of sign of f, which is positive exactly where two bodies are disjoint.
///
/// It scans the bracket in equal steps, each of which is `fraction` of it, for the first sample at which f is not
/// positive, and refines within that step. It does not notice what happens between two positive samples.
template <class Function>
RootSearch first_root(Function&& f, const Bracket& bracket, double fraction) {
  const int steps = scan_steps_of(fraction);
  RootSearch search;
  const auto counted = [&](double time) {
    ++search.evaluations;
    return f(time);
  };
  double before = bracket.earliest;
  double f_before = counted(before);
  if (!(f_before >= 0)) {
    search.time = before;
    return search;
  }
  for (int step = 1; step <= steps; ++step) {
    const double time = bracket.sample(step, steps);
    const double f_time = counted(time);
    if (!(f_time > 0)) {
      search.time = root_between(counted, before, f_before, time, f_time);
      return search;
    }
    before = time;
    f_before = f_time;
  }
  // The incircles touch at `latest`, whatever value f has by rounding.
  if (bracket.certain) search.time = bracket.latest;
  return search;
}

}  // namespace vitrel::bench
