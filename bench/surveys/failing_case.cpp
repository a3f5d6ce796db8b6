#include "bench/surveys/failing_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/perram_wertheim.h"
#include "core/geometry/free_flight.h"
#include "core/io/json.h"

namespace vitrel::bench {
namespace {

using TruthOutcome = TrueContact::Outcome;

struct Placed {
  Ellipse body;
  Vec2 position;
  double angle;
};

Placed placed(const Flight<GrowingEllipse>& flight, double time) {
  const Pose2 pose = advanced(flight.pose, flight.motion, time);
  return {flight.body.at(time), pose.position, pose.angle};
}

struct Moment {
  std::string title;
  double time;
  bool magnified = false;  // a small overlap, close up
};

bool overlap(const Placed& one, const Placed& two) {
  if (one.body.b <= 0 || two.body.b <= 0) return false;
  const Vec2 d = two.position - one.position;
  return !vieillard_baron(one.body, one.angle, two.body, two.angle, d).disjoint_or_touching();
}

/// How deep two overlapping ellipses are in each other: −(n·d − h₁ − h₂) along the common normal n of
/// the ellipses scaled by μ to touch, where n·d = μ (h₁ + h₂).
double depth(const Placed& one, const Placed& two) {
  const Vec2 d = two.position - one.position;
  const PerramWertheim<2> scaled = perram_wertheim(one.body, one.angle, two.body, two.angle, d);
  return scaled.normal.dot(d) * (1 / std::sqrt(scaled.value) - 1);
}

/// Where both ellipses must shrink most to come apart, among the times of the overlap that starts
/// at `from`, up to `to`. Sampled evenly in the logarithm of the time since, since a grazing overlap
/// lasts a tiny part of the horizon.
double deepest_overlap(const CollisionCase& asked, double from, double to) {
  constexpr int samples = 6000;
  constexpr double decades = 12;
  double deepest = from, largest = 0;
  for (int k = 0; k <= samples; ++k) {
    const double time = from + (to - from) * std::pow(10, decades * (k - samples) / samples);
    const Placed one = placed(asked.one, time), two = placed(asked.two, time);
    if (overlap(one, two)) {
      const double deep = depth(one, two);
      if (deep > largest) largest = deep, deepest = time;
    } else if (largest > 1e-13 * (one.body.a + two.body.a)) {
      break;  // not if rounding still hides the overlap
    }
  }
  return deepest;
}

bool has_contact(const FailingCase& failure) {
  return failure.truth.outcome == TruthOutcome::contact ||
         failure.truth.outcome == TruthOutcome::undecided;
}

/// The deepest overlap that a late or missing answer overlooks.
double overlooked_time(const FailingCase& failure) {
  const double from = has_contact(failure) ? static_cast<double>(failure.truth.time) : 0;
  const bool late = failure.assessment.verdict == Verdict::late;
  return deepest_overlap(failure.asked, from, late ? failure.answer.time : failure.asked.horizon);
}

bool overlooks_overlap(const FailingCase& failure) {
  const Verdict verdict = failure.assessment.verdict;
  return verdict == Verdict::late || verdict == Verdict::missed;
}

/// Curvature of the surface where its normal is n: h³/(a²b²), h the support function.
double curvature(const Placed& one, const Vec2& n) {
  const Vec2 major(std::cos(one.angle), std::sin(one.angle));
  const double h = std::hypot(one.body.a * major.dot(n), one.body.b * cross(major, n));
  return h * h * h / (one.body.a * one.body.a * one.body.b * one.body.b);
}

/// The length of the lens in which two ellipses overlap, about 2 √(2 depth/(sum of curvatures)).
double lens_size(const Placed& one, const Placed& two) {
  const Vec2 d = two.position - one.position;
  const Vec2 n = perram_wertheim(one.body, one.angle, two.body, two.angle, d).normal;
  return 2 * std::sqrt(2 * depth(one, two) / (curvature(one, n) + curvature(two, n)));
}

/// Too small to be seen beside whole ellipses, large enough for the arithmetic of a browser.
bool deserves_close_up(const CollisionCase& asked, double time) {
  const Placed one = placed(asked.one, time), two = placed(asked.two, time);
  if (!overlap(one, two)) return false;
  const double part = lens_size(one, two) / std::min(one.body.a, two.body.a);
  return part > 1e-3 && part < 0.25;
}

std::vector<Moment> moments(const FailingCase& failure) {
  std::vector<Moment> shown = {{"start", 0}};
  const auto truth = static_cast<double>(failure.truth.time);
  if (has_contact(failure)) shown.push_back({"true contact", truth});
  if (overlooks_overlap(failure)) {
    const double time = overlooked_time(failure);
    if (failure.answer.outcome != Outcome::contact || time < failure.answer.time)
      shown.push_back({failure.answer.outcome == Outcome::contact ? "deepest overlap before"
                                                                  : "deepest overlap",
                       time});
  }
  if (failure.answer.outcome == Outcome::contact)
    shown.push_back({"contact reported", failure.answer.time});
  std::ranges::stable_sort(shown, {}, &Moment::time);
  if (overlooks_overlap(failure) && deserves_close_up(failure.asked, overlooked_time(failure)))
    shown.push_back({"deepest overlap, magnified", overlooked_time(failure), true});
  return shown;
}

/// What a picture shows: a square about a point.
struct View {
  Vec2 centre;
  double half_width;
};

View view_of(const Placed& one, const Placed& two, bool magnified) {
  const Placed& small = one.body.a < two.body.a ? one : two;
  const double reach = std::max(small.body.a, 1e-300);
  if (magnified) {
    const Vec2 d = two.position - one.position;
    const Vec2 touch = perram_wertheim(one.body, one.angle, two.body, two.angle, d).point;
    return {one.position + touch, 0.8 * lens_size(one, two)};
  }
  if (std::max(one.body.a, two.body.a) > 12 * reach) return {small.position, 3 * reach};
  const Vec2 a(one.body.a, one.body.a), b(two.body.a, two.body.a);
  const Vec2 low = (one.position - a).cwiseMin(two.position - b);
  const Vec2 high = (one.position + a).cwiseMax(two.position + b);
  return {0.5 * (low + high), 0.54 * (high - low).maxCoeff()};
}

/// Relative to the centre of the view in units of its half width, so that a close-up keeps its digits.
Json ellipse_json(const Placed& body, const View& view) {
  const Vec2 r = (body.position - view.centre) / view.half_width;
  return {{"x", r.x()},
          {"y", r.y()},
          {"a", body.body.a / view.half_width},
          {"b", body.body.b / view.half_width},
          {"angle", std::remainder(body.angle, std::numbers::pi)}};
}

Json picture_json(const CollisionCase& asked, const Moment& moment) {
  const Placed one = placed(asked.one, moment.time), two = placed(asked.two, moment.time);
  const View view = view_of(one, two, moment.magnified);
  return {{"title", moment.title},
          {"time", moment.time},
          {"half_width", view.half_width},
          {"ellipses", {ellipse_json(one, view), ellipse_json(two, view)}},
          {"overlap", overlap(one, two)}};
}

std::string overlap_text(const CollisionCase& asked, double time, const char* words) {
  const Placed one = placed(asked.one, time), two = placed(asked.two, time);
  if (!overlap(one, two)) return "";
  return fmt::format("{} {:.2g} semi-minor axes", words, depth(one, two) / asked.gap_unit());
}

std::string failure_caption(const FailingCase& failure) {
  const CollisionCase& asked = failure.asked;
  const double off = std::abs(failure.answer.time - static_cast<double>(failure.truth.time));
  switch (failure.assessment.verdict) {
    case Verdict::late:
      return fmt::format("reports the contact {:.3g} too late{}", off,
                         overlap_text(asked, overlooked_time(failure),
                                      "; until then the ellipses overlap by up to"));
    case Verdict::early:
      return fmt::format("reports a contact {:.3g} too early", off);
    case Verdict::missed:
      return fmt::format(
          "{}{}",
          has_contact(failure)
              ? fmt::format("reports no contact before the horizon t = {:.4g}", asked.horizon)
              : std::string("misses that the pair overlaps at the start"),
          overlap_text(asked, overlooked_time(failure), ", but the ellipses overlap by up to"));
    case Verdict::false_contact:
      return "reports a contact for a pair that never touches";
    case Verdict::not_converged:
      return "does not converge";
    case Verdict::correct:
      break;
  }
  return "answers correctly";
}

}  // namespace

Json failing_case_json(const FailingCase& failure) {
  Json pictures = Json::array();
  for (const Moment& moment : moments(failure))
    pictures.push_back(picture_json(failure.asked, moment));
  const Vec2 v = failure.asked.two.motion.velocity - failure.asked.one.motion.velocity;
  return {{"method", failure.method},
          {"class", failure.case_class.name},
          {"aspect_ratio", failure.case_class.aspect_ratio},
          {"index", failure.index},
          {"caption", failure_caption(failure)},
          {"relative_velocity", {v.x(), v.y()}},
          {"pictures", pictures}};
}

}  // namespace vitrel::bench
