#pragma once

#include <cstdint>
#include <vector>

#include "bench/programs/report.h"
#include "bench/surveys/thesis_run.h"

namespace vitrel::bench {

struct ThesisOptions {
  double seconds = 1;     ///< that one run of the thesis's program may work; it then is cut short
  double duration = 100;  ///< simulated time of runs; longer for fewer than 400 particles
  int largest = 400;      ///< number of particles
  int relaxations = 32;   ///< runs that are averaged in figure 4.7
  std::uint64_t seed = 1;
};

/// `vitrel-bench thesis`: what the figures of chapter 4 of the thesis show (woetzel2012), with
/// its program (all pairs, SLSQP) and with this one.
int thesis(const ThesisOptions& options, const OutputOptions& output);

struct ThesisRow {
  Program program;
  ThesisScene scene;
  double brownian_step = 0;  ///< 0: Newtonian
  ThesisRun run;

  double per_unit_of_time() const { return run.seconds / run.simulated_time; }  ///< seconds
};

/// How the time per unit of simulated time grows with N: the slope of a straight line through the
/// logarithms, Newtonian and Brownian runs together; NaN for fewer than two sizes.
double growth_exponent(const std::vector<ThesisRow>& rows, Program program, double kappa);

}  // namespace vitrel::bench
