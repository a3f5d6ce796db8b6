#include "bench/lab/judge.h"

#include <cmath>
#include <limits>

#include "bench/lab/reference/true_gap.h"
#include "bench/lab/solids/truth.h"

namespace vitrel::lab {

namespace {

template <int Dim>
bool answers_contact(const Prediction<Dim>& answer) {
  return answer.outcome == Outcome::contact || answer.outcome == Outcome::overlap;
}

// An overlap found at the start is a contact at time 0.
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

// A contact answered where a true one exists; `off` is the time error.
Verdict timing(double off, double allowed, bool degenerate, bool at_rounding) {
  if (std::abs(off) <= allowed) return Verdict::correct;
  if (off > 0) return Verdict::late;
  return degenerate && at_rounding ? Verdict::correct : Verdict::early;
}

}  // namespace

template <int Dim>
Judgement judge(const CollisionCaseOf<Dim>& asked, const TrueContactOf<Dim>& truth,
                const Prediction<Dim>& answer, const JudgingTolerance& tolerance) {
  using Truth = typename TrueContactOf<Dim>::Outcome;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  // The truth itself is no better known than that.
  const double allowed = tolerance.time * asked.horizon + static_cast<double>(truth.uncertainty);
  Judgement judgement{Verdict::correct, is_degenerate(asked, truth), none, none};

  const bool contact = answers_contact(answer);
  const double time = time_of(answer);
  if (answer.outcome == Outcome::not_converged || (contact && !std::isfinite(time))) {
    judgement.verdict = Verdict::not_converged;
    return judgement;
  }
  if (truth.outcome == Truth::overlap_at_start) {
    judgement.verdict = contact && time <= allowed ? Verdict::correct : Verdict::missed;
    return judgement;
  }
  if (!contact) {
    judgement.verdict = truth.outcome == Truth::contact ? Verdict::missed : Verdict::correct;
    return judgement;
  }

  const auto off = static_cast<double>(time - truth.time);
  const bool near_in_time = truth.outcome == Truth::contact && std::abs(off) <= allowed;
  const auto gap = static_cast<double>(true_gap(asked.one, asked.two, time));
  const bool at_rounding = gap <= tolerance.gap * asked.gap_unit();
  judgement.gap_error = gap;
  if (truth.outcome == Truth::contact) judgement.time_error = off;
  if (!at_rounding && !near_in_time &&
      (truth.outcome != Truth::contact || answer.outcome == Outcome::overlap))
    judgement.verdict = Verdict::false_contact;
  else if (truth.outcome == Truth::contact)
    judgement.verdict = timing(off, allowed, judgement.degenerate, at_rounding);
  return judgement;
}

template Judgement judge(const CollisionCase&, const TrueContact&, const Prediction2&,
                         const JudgingTolerance&);
template Judgement judge(const SolidCase&, const TrueSolidContact&, const Prediction3&,
                         const JudgingTolerance&);

}  // namespace vitrel::lab
