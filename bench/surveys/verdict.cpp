#include "bench/surveys/verdict.h"

#include <cmath>
#include <limits>

namespace vitrel::bench {

namespace {

template <int Dim>
bool answers_contact(const Prediction<Dim>& answer) {
  return answer.outcome == Outcome::contact || answer.outcome == Outcome::overlap;
}

// An overlap that a method finds at the start counts as a contact at time 0.
template <int Dim>
double time_of(const Prediction<Dim>& answer) {
  return answer.outcome == Outcome::overlap ? 0 : answer.time;
}

template <int Dim>
bool is_degenerate(const CollisionCaseOf<Dim>& asked, const TrueContactOf<Dim>& truth) {
  using Truth = typename TrueContactOf<Dim>::Outcome;
  if (truth.outcome == Truth::undecided) return true;
  if (truth.outcome != Truth::contact) return false;
  return truth.approach_speed < 0.02 * asked.reach() / asked.horizon;
}

// The verdict on a reported contact if there is a true one; `off` is the error of its time.
Verdict timing(double off, double allowed, bool degenerate, bool at_rounding) {
  if (std::abs(off) <= allowed) return Verdict::correct;
  if (off > 0) return Verdict::late;
  return degenerate && at_rounding ? Verdict::correct : Verdict::early;
}

/// The change of the contact time if each number of the initial rotations changes by one unit in the last place of
/// its vector, with all changes added.
double effect_of_rounding(const EllipsoidCase& asked, const TrueEllipsoidContact& truth) {
  constexpr double unit = std::numeric_limits<double>::epsilon();
  double sum = 0;
  const auto add = [&](Flight<GrowingEllipsoid> EllipsoidCase::*body, const auto& number_of,
                       int numbers, double size) {
    for (int k = 0; k < numbers; ++k) {
      EllipsoidCase other = asked;
      number_of(other.*body)[k] += unit * size;
      let_tumble(other);
      const TrueEllipsoidContact moved = truth_of(other);
      if (moved.outcome == TrueEllipsoidContact::Outcome::contact)
        sum += static_cast<double>(std::abs(moved.time - truth.time));
    }
  };
  for (const auto body : {&EllipsoidCase::one, &EllipsoidCase::two}) {
    add(
        body, [](auto& flight) -> Vec3& { return flight.motion.angular_velocity; }, 3,
        (asked.*body).motion.angular_velocity.norm());
    add(
        body, [](auto& flight) -> auto& { return flight.pose.orientation.coeffs(); }, 4, 1);
  }
  return sum;
}

/// The allowed error of the time. `off` is the actual one: if it is small, the allowed one need not be known exactly.
template <int Dim>
double allowed_error(const CollisionCaseOf<Dim>& asked, const TrueContactOf<Dim>& truth,
                     double tolerance, double off, bool degenerate) {
  constexpr int roundings = 10;
  if (std::abs(off) <= tolerance) return tolerance;
  if constexpr (Dim == 3)
    if (asked.tumbles() && !degenerate)
      return tolerance + roundings * effect_of_rounding(asked, truth);
  return tolerance + static_cast<double>(truth.uncertainty);
}

}  // namespace

template <int Dim>
TrueContactOf<Dim> truth_of(const CollisionCaseOf<Dim>& asked) {
  if constexpr (Dim == 3)
    if (asked.tumbles())
      return true_first_contact(asked.tumbling[0], asked.tumbling[1], asked.horizon);
  return true_first_contact(asked.one, asked.two, asked.horizon);
}

template <int Dim>
long double gap_at(const CollisionCaseOf<Dim>& asked, long double time) {
  if constexpr (Dim == 3)
    if (asked.tumbles()) return true_gap(asked.tumbling[0], asked.tumbling[1], time);
  return true_gap(asked.one, asked.two, time);
}

template <int Dim>
Assessment assess(const CollisionCaseOf<Dim>& asked, const TrueContactOf<Dim>& truth,
                  const Prediction<Dim>& answer, const AllowedError& tolerance) {
  using Truth = typename TrueContactOf<Dim>::Outcome;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const double tolerated = tolerance.time * asked.horizon;
  Assessment assessment{Verdict::correct, is_degenerate(asked, truth), none, none};

  const bool contact = answers_contact(answer);
  const double time = time_of(answer);
  if (answer.outcome == Outcome::not_converged || (contact && !std::isfinite(time))) {
    assessment.verdict = Verdict::not_converged;
    return assessment;
  }
  if (truth.outcome == Truth::overlap_at_start) {
    assessment.verdict = contact && time <= tolerated ? Verdict::correct : Verdict::missed;
    return assessment;
  }
  if (!contact) {
    assessment.verdict = truth.outcome == Truth::contact ? Verdict::missed : Verdict::correct;
    return assessment;
  }

  const auto off = static_cast<double>(time - truth.time);
  const double allowed = truth.outcome == Truth::contact
                             ? allowed_error(asked, truth, tolerated, off, assessment.degenerate)
                             : tolerated;
  const bool near_in_time = truth.outcome == Truth::contact && std::abs(off) <= allowed;
  const auto gap = static_cast<double>(gap_at(asked, time));
  const bool at_rounding = gap <= tolerance.gap * asked.gap_unit();
  assessment.gap_error = gap;
  if (truth.outcome == Truth::contact) assessment.time_error = off;
  if (!at_rounding && !near_in_time &&
      (truth.outcome != Truth::contact || answer.outcome == Outcome::overlap))
    assessment.verdict = Verdict::false_contact;
  else if (truth.outcome == Truth::contact)
    assessment.verdict = timing(off, allowed, assessment.degenerate, at_rounding);
  return assessment;
}

template TrueContact truth_of(const CollisionCase&);
template TrueEllipsoidContact truth_of(const EllipsoidCase&);
template long double gap_at(const CollisionCase&, long double);
template long double gap_at(const EllipsoidCase&, long double);
template Assessment assess(const CollisionCase&, const TrueContact&, const Prediction2&,
                           const AllowedError&);
template Assessment assess(const EllipsoidCase&, const TrueEllipsoidContact&, const Prediction3&,
                           const AllowedError&);

}  // namespace vitrel::bench
