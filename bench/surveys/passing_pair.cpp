#include "bench/surveys/passing_pair.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/methods/ellipsoids/methods.h"
#include "bench/methods/opening.h"
#include "bench/surveys/ellipsoid_reference.h"
#include "bench/surveys/ellipsoid_suite.h"
#include "core/io/json.h"

namespace vitrel::bench {
namespace {

constexpr double depth = 3e-5;
constexpr int scan_steps = 100;
constexpr double passing = 3;  // when the overlap is deepest

EllipsoidCase pair() {
  return passing_pair(depth);
}

TrueEllipsoidContact truth() {
  const EllipsoidCase asked = pair();
  return true_first_contact(asked.one, asked.two, asked.horizon);
}

double eta1_at(double time) {
  return ellipsoid_eta_at(pair(), time).eta1;
}

/// η₁ against time about the overlap, and at the samples of a scan of the usual step.
Json eta1_json() {
  constexpr int samples = 400, shown_steps = 2;
  const Bracket bracket = *bracket_contact(pair());
  const double reach = shown_steps * bracket.duration() / scan_steps;
  Json curve, scan;
  const auto add = [](Json& to, double time) {
    to["time"].push_back(time);
    to["eta1"].push_back(eta1_at(time));
  };
  for (int k = 0; k <= samples; ++k) add(curve, passing + reach * (2.0 * k / samples - 1));
  for (int step = 0; step <= scan_steps; ++step)
    if (const double time = bracket.sample(step, scan_steps); std::abs(time - passing) <= reach)
      add(scan, time);
  return {{"curve", curve}, {"scan", scan}, {"scan_steps", scan_steps}};
}

}  // namespace

Json passing_pair_json() {
  Json answers = Json::array();
  for (const MethodOf<3>& method : ellipsoid_methods_by_tolerance()) {
    const Prediction3 answer = method.predict(pair());
    const bool contact = answer.outcome == Outcome::contact;
    answers.push_back({{"method", method.name},
                       {"tolerance", method.tolerance},
                       {"time", contact ? Json(answer.time) : Json(nullptr)},
                       {"steps", answer.steps}});
  }
  return {{"depth", depth},
          {"contact", static_cast<double>(truth().time)},
          {"answers", answers},
          {"eta1", eta1_json()}};
}

}  // namespace vitrel::bench
