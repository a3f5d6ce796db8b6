#pragma once

namespace vitrel::bench {

/// The objective of the methods of NLopt: the time, which is the first of the three variables.
inline double time_objective(unsigned, const double* x, double* gradient, void*) {
  if (gradient) {
    gradient[0] = 1;
    gradient[1] = gradient[2] = 0;
  }
  return x[0];
}

}  // namespace vitrel::bench
