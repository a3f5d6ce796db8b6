#pragma once

#include <array>

#include "bench/methods/collision_case.h"
#include "bench/surveys/true_contact.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// The error with which an answer still counts as correct.
struct AllowedError {
  double time = 1e-8;  ///< as a fraction of the horizon
  double gap = 1e-8;   ///< in units of the smaller semi-minor axis
};

/// The verdict on an answer.
///
/// - If the pair overlaps at the start, the answers `overlap`, and `contact` at time 0 within the time tolerance,
///   are right (a method need not distinguish the two). Any other answer is missed.
/// - If there is a contact at τ, the answer `none` is missed. A contact is right within the time tolerance of τ, else
///   late or early. If the pair is degenerate, an early contact is right if the true gap at the reported time is
///   within the gap tolerance. Overlap counts as a contact at time 0, but as false if the surfaces are then apart by
///   more than the tolerance.
///   The uncertainty of τ is added to the tolerance. If the bodies tumble, and the pair is not degenerate,
///   ten times the following change of τ is added instead: the sum of the changes by one unit in the last place of
///   each number of the initial orientations and angular velocities (of its vector), which is large near the
///   separatrix.
/// - If there is no contact, or if it is undecided because the surfaces touch within the rounding of the reference,
///   the answer `none` is right. A contact is right if the true gap at the reported time is within the tolerance, else
///   false.
/// - A time that is not a number is not converged.
enum class Verdict {
  correct,
  early,   ///< the contact is reported before the true one, by more than the tolerance
  late,    ///< the contact is reported after the true one, by more than the tolerance
  missed,  ///< a contact (or overlap at the start) exists, but none is reported
  /// A contact is reported where there is none, and the true gap exceeds the tolerance.
  false_contact,
  not_converged,
};

/// The names of the verdicts in the studies.
inline constexpr std::array<const char*, 6> verdict_names{"correct", "early", "late",
                                                          "missed",  "false", "not_converged"};

struct Assessment {
  Verdict verdict = Verdict::correct;
  /// Whether the surfaces cross so slowly that a gap of the size of rounding lasts for a long time. An early answer
  /// is then judged by the true gap at the reported time. A pair is degenerate if the speed of its surfaces at the
  /// true contact is below 0.02 (a₁ + a₂)/horizon, or if it is undecided whether they touch.
  bool degenerate = false;
  double time_error = 0;  ///< reported − true time; NaN unless both report a contact
  /// The true gap at the reported time, in units of length; NaN if no contact is reported, or if the pair overlaps at
  /// the start.
  double gap_error = 0;
};

/// The true first contact up to the horizon, and below the true gap at a time.
template <int Dim>
TrueContactOf<Dim> truth_of(const CollisionCaseOf<Dim>& asked);
template <int Dim>
long double gap_at(const CollisionCaseOf<Dim>& asked, long double time);

template <int Dim>
Assessment assess(const CollisionCaseOf<Dim>& asked, const TrueContactOf<Dim>& truth,
                  const Prediction<Dim>& answer, const AllowedError& tolerance);

}  // namespace vitrel::bench
