#pragma once

#include <string>
#include <vector>

namespace vitrel {

/// A mean square displacement or rotation against the time difference.
struct MeanSquareCurve {
  std::vector<double> time;  ///< ascending, above 0
  std::vector<double> value;
  std::vector<double> error;  ///< standard errors; NaN where unknown
  /// Duration of the run, every frame of which is an origin of time; 0: the first frame is the
  /// only origin.
  double duration = 0;
};

struct DiffusionCoefficient {
  double value;        ///< NaN if there is none
  double error;        ///< standard error
  double from, to;     ///< time differences between which the slope was fitted
  std::string reason;  ///< why there is no value; else empty
};

/// None, for this reason.
DiffusionCoefficient no_coefficient(const std::string& reason);

/// The long-time diffusion coefficient D, from m(t) → 2 d D t + constant: d = 2 for translation, 1
/// for rotation.
///
/// 1. A straight line is fitted over [t, T]: T is the longest time with an error, t that at which m = 1, so that
///    particles have moved by one unit (of length, or radian), but within T/27 and T/3. Constants (short-time
///    motion, rattling in a cage) drop out. The window does not depend on how straight m is by chance: the
///    longest window that looks straight has a slope that scatters up to 1.8 times as much as its
///    error says (measured). Weights are those of the errors that diffusion would have: measured errors
///    are large where m is by chance, and would make the slope too small.
/// 2. m is straight if the slopes of lines fitted to the earlier and to the later half of the window (in ln t)
///    differ by no more than three standard errors of that difference. If not, the window is [T/9, T].
/// 3. Statistical errors: the points of m share their noise. Its correlation between two times is
///    taken to be that of diffusion with these origins,
///      ρ(s, t) ∝ mean over origins a, b of (overlap of [a, a + s] with [b, b + t])²,
///    (qian1991, there as sums), its size from the errors of m. A single origin has ρ = s/t, s < t.
/// 4. If that is not straight either, but its halves agree within 10 %, the line is fitted over [T/3, T], and the
///    error is the larger of the statistical one and the difference of the halves.
///
/// NaN with a reason where 4 fails, where T is less than nine times the shortest time, or where m(T)
/// < 1. Throws UserError for columns of
/// different lengths or times that do not ascend.
DiffusionCoefficient diffusion_coefficient(const MeanSquareCurve& curve, int dimension);

}  // namespace vitrel
