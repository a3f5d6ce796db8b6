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

/// The long-time diffusion coefficient D, from m(t) → 2 d D t + constant: d = 2 for translation, 1
/// for rotation.
///
/// 1. Where m is straight: [t, T], T the longest time with an error, is straight if the slopes of a
///    line fitted to its earlier and to its later half (in ln t) differ by no more than three
///    standard errors of that difference. The windows are followed from t = T/9 down to the last
///    straight one. (With two errors, chance would stop this so often just where the later half is
///    off that errors covered only 62 %.)
/// 2. The line is fitted from three times that t on, at least over [T/3, T]. The factor keeps off
///    what step 1 cannot see; constants (short-time motion, rattling in a cage) drop out. Weights are
///    those of the errors that diffusion would have: measured errors are large where m is by chance,
///    and would make the slope too small.
/// 3. Statistical errors: the points of m share their noise. Its correlation between two times is
///    taken to be that of diffusion with these origins,
///      ρ(s, t) ∝ mean over origins a, b of (overlap of [a, a + s] with [b, b + t])²,
///    (qian1991, there as sums), its size from the errors of m. A single origin has ρ = s/t, s < t.
/// 4. If not even [T/9, T] is straight, D is given if its halves agree within 10 %, and the error is
///    the larger of the statistical one and their difference.
///
/// NaN with a reason where 4 fails, where T is less than nine times the shortest time, or where m(T)
/// < 1: particles must have moved by one unit (of length, or radian). Throws UserError for columns of
/// different lengths or times that do not ascend.
DiffusionCoefficient diffusion_coefficient(const MeanSquareCurve& curve, int dimension);

}  // namespace vitrel
