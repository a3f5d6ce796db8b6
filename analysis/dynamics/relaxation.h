#pragma once

#include <string>
#include <vector>

#include "analysis/statistics/blocking.h"

namespace vitrel {

/// A correlation that decays from 1 at time difference 0.
struct Decay {
  std::vector<double> time;  ///< ascending, above 0
  std::vector<double> value;
  std::vector<double> error;  ///< standard errors; NaN where unknown
};

struct RelaxationTime {
  double value;        ///< NaN if there is none
  double error;        ///< standard error; NaN where none can be given
  double least;        ///< without a value: a time that the correlation outlives; NaN if unknown
  double most;         ///< without a value: a time by which it has decayed; NaN if unknown
  std::string reason;  ///< why there is no value; else empty
};

/// Returns the time τ at which a correlation has fallen to 1/e.
///
/// 1. The first time at which the correlation is not above 1/e shows where τ is, up to noise.
/// 2. There a straight line in ln t is fitted to all points within a factor 5/4 of that time, and to the two points on
///    both sides of 1/e if these are farther. τ is where the line is 1/e. exp(−(t/τ)^β) has its point of inflection in
///    ln t at τ for every β, so the line is wrong in third order only: by less than 0.2 % of τ for β ≤ 1.
/// 3. The error is that of a line through the errors of these points, at τ, over the slope of the line. Neighbouring
///    times share their noise, so more points do not make it smaller.
///
/// There is no value if the correlation does not fall that far within its times, if it is below 1/e from the first time
/// on, or if it returns above 1/e by more than three errors. Throws UserError if columns are empty or have different
/// lengths, or if times do not ascend.
RelaxationTime relaxation_time(const Decay& correlation);

/// Returns the connected part (C − P)/(1 − P) of a correlation that ends on a plateau P < 1 because there is order; the
/// connected part decays from 1 to 0 again. L₂ of a nematic, seen from its director (director_frame.h), has the plateau
/// ⟨S⟩², because the angles α to the director are such that ⟨sin 2α⟩ = 0 and ⟨cos 2α⟩ = S. `plateau` has a standard
/// error, which adds to that of the correlation.
Decay connected_part(const Decay& correlation, const Estimate& plateau);

}  // namespace vitrel
