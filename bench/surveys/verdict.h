#pragma once

#include <array>

#include "bench/methods/collision_case.h"
#include "bench/surveys/true_contact.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// By how much an answer may be off and still count as correct.
struct AllowedError {
  double time = 1e-8;  ///< as a fraction of the horizon
  double gap = 1e-8;   ///< in units of the smaller semi-minor axis
};

/// What is said about an answer.
///
/// - Overlap at the start: right if the answer is overlap, or a contact at time 0 within the time
///   tolerance (a method need not tell the two apart); any other is missed.
/// - A contact at τ: none is missed; a contact is right within the time tolerance of τ, else late,
///   or early, or, if the pair is degenerate and the true gap at the reported time is within the gap
///   tolerance, right though early. Overlap counts as a contact at time 0, but as false if the
///   surfaces are then apart by more than the tolerance.
///   To the tolerance is added the uncertainty of τ; if the bodies tumble, and the pair is not degenerate,
///   instead ten times what one unit in the last place of each number of the initial orientations and
///   angular velocities does to τ (of its vector; all added), which near the separatrix is much.
/// - No contact, or undecided (the surfaces touch to within the rounding of the reference): none is
///   right; a contact is right if the true gap at the reported time is within the tolerance, else
///   false.
/// - A time that is no number is not converged.
enum class Verdict {
  correct,
  early,          ///< contact reported before the true one, by more than the tolerance
  late,           ///< contact reported after the true one, by more than the tolerance
  missed,         ///< contact (or overlap at the start) exists, none reported
  false_contact,  ///< contact reported where there is none and the true gap exceeds the tolerance
  not_converged,
};

/// As the studies call them.
inline constexpr std::array<const char*, 6> verdict_names{"correct", "early", "late",
                                                          "missed",  "false", "not_converged"};

struct Assessment {
  Verdict verdict = Verdict::correct;
  /// The surfaces cross so slowly that a gap of the size of rounding is a long time: then an early
  /// answer counts by the true gap at the reported time. A pair is degenerate if the speed of
  /// its surfaces at the true contact is below 0.02 (a₁ + a₂)/horizon, or if it is undecided
  /// whether they touch.
  bool degenerate = false;
  double time_error = 0;  ///< reported − true time; NaN unless both report a contact
  /// True gap at the reported time, in units of length; NaN if no contact is reported, or if the pair
  /// overlaps at the start.
  double gap_error = 0;
};

/// The true first contact up to the horizon, and the true gap at a time.
template <int Dim>
TrueContactOf<Dim> truth_of(const CollisionCaseOf<Dim>& asked);
template <int Dim>
long double gap_at(const CollisionCaseOf<Dim>& asked, long double time);

template <int Dim>
Assessment assess(const CollisionCaseOf<Dim>& asked, const TrueContactOf<Dim>& truth,
                  const Prediction<Dim>& answer, const AllowedError& tolerance);

}  // namespace vitrel::bench
