#pragma once

#include <string>
#include <vector>

namespace vitrel {

/// A mean square displacement or rotation against the time difference.
struct MeanSquareCurve {
  std::vector<double> time;  ///< ascending, above 0
  std::vector<double> value;
  std::vector<double> error;  ///< standard errors; NaN where unknown
  /// Duration of the run, every frame of which is an origin of time. If it is 0, the first frame is the only origin.
  double duration = 0;
};

struct DiffusionCoefficient {
  double value;        ///< NaN if there is none
  double error;        ///< standard error
  double from, to;     ///< time differences between which the slope was fitted
  std::string reason;  ///< why there is no value; else empty
};

/// Returns no coefficient, for this reason.
DiffusionCoefficient no_coefficient(const std::string& reason);

/// Returns the long-time diffusion coefficient D, from m(t) → 2 d D t + constant, with d = 2 for translation and 1 for
/// rotation.
///
/// 1. A straight line is fitted over [t, T], where T is the longest time with an error. t is the time at which m = 1,
///    so that particles have moved by one unit (of length, or radian), but lies between T/27 and T/3. Constants
///    (short-time motion, rattling in a cage) drop out. The window does not depend on how straight m is by chance: the
///    longest window that looks straight has a slope that scatters up to 1.8 times as much as its error says
///    (measured). The weights are those of the errors that diffusion would have: measured errors are large where m is
///    large by chance, and would make the slope too small.
/// 2. m is straight if the slopes of lines fitted to the earlier and to the later half of the window (in ln t) differ
///    by no more than three standard errors of that difference. If not, the window is [T/9, T].
/// 3. Statistical errors: the points of m share their noise. Its correlation between two times is taken to be that of
///    diffusion with these origins,
///      ρ(s, t) ∝ mean over origins a, b of (overlap of [a, a + s] with [b, b + t])²,
///    (qian1991, there as sums); its size follows from the errors of m. A single origin has ρ = s/t, s < t.
/// 4. If m is not straight in that window either, but its halves agree within 10 %, the line is fitted over [T/3, T],
///    and the error is the larger of the statistical one and the difference of the halves.
///
/// D is NaN with a reason if step 4 fails, if T is less than nine times the shortest time, or if m(T) < 1. Throws
/// UserError for columns of different lengths or times that do not ascend.
DiffusionCoefficient diffusion_coefficient(const MeanSquareCurve& curve, int dimension);

}  // namespace vitrel
