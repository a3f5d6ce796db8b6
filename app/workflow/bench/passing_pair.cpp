#include "app/workflow/bench/passing_pair.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/lab/methods/opening.h"
#include "bench/lab/solids/methods.h"
#include "bench/lab/solids/suite.h"
#include "bench/lab/solids/truth.h"

namespace vitrel {
namespace {

constexpr double depth = 3e-5;
constexpr int scan_steps = 100;
constexpr double passing = 3;  // when the overlap is deepest

lab::SolidCase pair() {
  return lab::passing_pair(depth);
}

lab::TrueSolidContact truth() {
  const lab::SolidCase asked = pair();
  return lab::true_first_contact(asked.one, asked.two, asked.horizon);
}

ChartPoint eta1_at(double time) {
  return {time, lab::ellipsoid_eta_at(pair(), time).eta1, false, ""};
}

}  // namespace

Chart passing_pair_chart() {
  constexpr int samples = 400, shown_steps = 2;
  const lab::Bracket bracket = *lab::bracket_contact(pair());
  const double reach = shown_steps * bracket.duration() / scan_steps;
  Chart chart;
  chart.title = "Two ellipsoids pass and overlap for a moment: η₁(t)";
  chart.x.title = "time t";
  chart.y.title = "η₁";
  chart.zero_line = true;
  ChartSeries curve{"η₁(t)", {}, false};
  ChartSeries seen{fmt::format("in {} steps", scan_steps), {}, true};
  for (int k = 0; k <= samples; ++k)
    curve.points.push_back(eta1_at(passing + reach * (2.0 * k / samples - 1)));
  for (int step = 0; step <= scan_steps; ++step) {
    const double time = bracket.sample(step, scan_steps);
    if (std::abs(time - passing) <= reach) seen.points.push_back(eta1_at(time));
  }
  chart.series = {curve, seen};
  const auto first = static_cast<double>(truth().time);
  chart.marks = {{first, 0, fmt::format("contact, t = {:.4f}", first)}};
  return chart;
}

nlohmann::ordered_json passing_pair_json() {
  using Json = nlohmann::ordered_json;
  Json answers = Json::array();
  for (const lab::MethodOf<3>& method : lab::solid_methods_by_tolerance()) {
    const Prediction3 answer = method.predict(pair());
    const bool contact = answer.outcome == Outcome::contact;
    answers.push_back({{"method", method.name},
                       {"tolerance", method.tolerance},
                       {"time", contact ? Json(answer.time) : Json(nullptr)},
                       {"steps", answer.steps}});
  }
  return {{"depth", depth}, {"contact", static_cast<double>(truth().time)}, {"answers", answers}};
}

}  // namespace vitrel
