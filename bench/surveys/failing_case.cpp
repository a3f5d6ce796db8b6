#include "bench/surveys/failing_case.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace vitrel::bench {
namespace {

std::string failure_text(const FailingCase& failure) {
  const double off = std::abs(failure.answer.time - static_cast<double>(failure.truth.time));
  switch (failure.assessment.verdict) {
    case Verdict::late:
      return fmt::format("reports the contact {:.3g} too late", off);
    case Verdict::early:
      return fmt::format("reports a contact {:.3g} too early", off);
    case Verdict::missed:
      return fmt::format("reports no contact before the horizon t = {:.4g}", failure.asked.horizon);
    case Verdict::false_contact:
      return fmt::format("reports a contact at t = {:.12g}", failure.answer.time);
    case Verdict::not_converged:
      return "does not converge";
    case Verdict::correct:
      break;
  }
  return "answers correctly";
}

std::string truth_text(const TrueContact& truth) {
  if (truth.outcome == TrueContact::Outcome::none) return "there is none";
  if (truth.outcome == TrueContact::Outcome::overlap_at_start)
    return "the pair overlaps at the start";
  return fmt::format("the first one is at t = {:.12g}", static_cast<double>(truth.time));
}

std::string body_words(const Flight<GrowingEllipse>& flight) {
  const Ellipse body = flight.body.at(0);
  const Pose2& pose = flight.pose;
  const Motion2& motion = flight.motion;
  return fmt::format(
      " --body 'semi_axes={},{} position={},{} angle={} velocity={},{} angular_velocity={}'",
      body.a, body.b, pose.position.x(), pose.position.y(), pose.angle, motion.velocity.x(),
      motion.velocity.y(), motion.angular_velocity);
}

/// The command that draws the pair; empty if a body grows, which `vitrel pair path` does not support.
std::string command(const CollisionCase& asked) {
  if (asked.one.body.growth_rate != 0 || asked.two.body.growth_rate != 0) return "";
  return fmt::format("vitrel pair path{}{} --until {} -o pair.html", body_words(asked.one),
                     body_words(asked.two), asked.horizon);
}

}  // namespace

Json failing_case_json(const FailingCase& failure) {
  return {{"method", failure.method},
          {"class", failure.case_class.name},
          {"aspect_ratio", failure.case_class.aspect_ratio},
          {"index", failure.index},
          {"caption", failure_text(failure) + "; " + truth_text(failure.truth)},
          {"command", command(failure.asked)}};
}

}  // namespace vitrel::bench
