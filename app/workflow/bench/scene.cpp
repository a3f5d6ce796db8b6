#include "app/workflow/bench/scene.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bench/lab/methods/method.h"
#include "bench/lab/reference/first_contact.h"

#include "core/contact/ellipse_vieillard_baron.h"

namespace vitrel {
namespace {

const Flight<Ellipse> resting{{1, 0.5}, {{0, 0}, 0}, {{0, 0}, 0}};
const Flight<Ellipse> coming{{1, 0.5}, {{1, 1}, 0}, {{-1, 0}, std::numbers::pi}};
constexpr double duration = 2;
constexpr int samples = 800;

/// The point of the boundary of `coming` with parameter `angle`, where `resting` is the unit circle.
Vec2 mapped_point(double time, double angle) {
  const Pose2 pose = advanced(coming.pose, coming.motion, time);
  const Vec2 major(std::cos(pose.angle), std::sin(pose.angle));
  const Vec2 point = pose.position + coming.body.a * std::cos(angle) * major +
                     coming.body.b * std::sin(angle) * perpendicular(major);
  return {point.x() / resting.body.a, point.y() / resting.body.b};
}

/// Distance of the origin from the boundary by sampling it and refining about the nearest sample.
double mapped_distance(double time) {
  constexpr int steps = 720;
  const auto distance = [&](double angle) { return mapped_point(time, angle).norm(); };
  double nearest = 0, spacing = 2 * std::numbers::pi / steps;
  for (int k = 1; k < steps; ++k)
    if (distance(k * spacing) < distance(nearest)) nearest = k * spacing;
  for (; spacing > 1e-9; spacing *= 0.5)
    for (const double angle : {nearest - spacing, nearest + spacing})
      if (distance(angle) < distance(nearest)) nearest = angle;
  return distance(nearest);
}

double gap(double time) {
  return mapped_distance(time) - 1;
}

double psi(double time) {
  const Pose2 pose = advanced(coming.pose, coming.motion, time);
  return vieillard_baron(resting.body, resting.pose.angle, coming.body, pose.angle,
                         pose.position - resting.pose.position)
      .psi;
}

double first_touch() {
  return static_cast<double>(lab::true_first_contact(resting, coming, duration).time);
}

Chart scene_chart(const std::string& title, const std::string& name, double (*function)(double)) {
  Chart chart;
  chart.title = title;
  chart.x.title = "time t";
  chart.y.title = name;
  chart.zero_line = true;
  ChartSeries curve{name, {}, false};
  for (int k = 0; k <= samples; ++k) {
    const double time = duration * k / samples;
    curve.points.push_back({time, function(time), false, ""});
  }
  chart.series = {curve};
  const double first = first_touch();
  chart.marks = {{first, 0, fmt::format("first contact, t = {:.4f}", first)},
                 {1, 0, "touching again, t = 1"}};
  return chart;
}

}  // namespace

Chart scene_gap_chart() {
  return scene_chart("Two ellipses that touch, overlap and touch again: distance", "d(t)", gap);
}

Chart scene_psi_chart() {
  return scene_chart("Two ellipses that touch, overlap and touch again: contact function", "Ψ(t)",
                     psi);
}

std::vector<SceneAnswer> scene_answers() {
  const lab::CollisionCase asked{lab::of_constant_size(resting), lab::of_constant_size(coming),
                                 duration};
  std::vector<SceneAnswer> answers = {{"reference", 0, first_touch()}};
  for (const lab::Method& method : lab::collision_time_methods()) {
    const Prediction2 found = method.predict(asked);
    if (found.outcome == Outcome::not_converged) continue;
    answers.push_back({method.name, method.tolerance, {}});
    if (found.outcome == Outcome::contact) answers.back().time = found.time;
  }
  return answers;
}

nlohmann::ordered_json scene_json(const std::vector<SceneAnswer>& answers) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SceneAnswer& answer : answers) {
    list.push_back({{"method", answer.method}, {"tolerance", answer.tolerance}, {"time", nullptr}});
    if (answer.time) list.back()["time"] = *answer.time;
  }
  return list;
}

}  // namespace vitrel
