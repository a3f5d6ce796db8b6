#include "bench/surveys/thesis_scene.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "bench/methods/method.h"
#include "bench/reference/first_contact.h"
#include "core/contact/ellipse_vieillard_baron.h"
#include "core/geometry/free_flight.h"
#include "core/io/json.h"

namespace vitrel::bench {
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
  return static_cast<double>(true_first_contact(resting, coming, duration).time);
}

struct Answer {
  std::string method;
  double tolerance;
  std::optional<double> time;
};

std::vector<Answer> answers() {
  const CollisionCase asked{of_constant_size(resting), of_constant_size(coming), duration};
  std::vector<Answer> list = {{"reference", 0, first_touch()}};
  for (const Method& method : collision_time_methods()) {
    const Prediction2 found = method.predict(asked);
    if (found.outcome == Outcome::not_converged) continue;
    list.push_back({method.name, method.tolerance, {}});
    if (found.outcome == Outcome::contact) list.back().time = found.time;
  }
  return list;
}

}  // namespace

Json thesis_scene_answers_json() {
  Json list = Json::array();
  for (const Answer& answer : answers()) {
    list.push_back({{"method", answer.method}, {"tolerance", answer.tolerance}, {"time", nullptr}});
    if (answer.time) list.back()["time"] = *answer.time;
  }
  return list;
}

Json thesis_scene_curves_json() {
  Json curves = {{"first_contact", first_touch()}};
  for (int k = 0; k <= samples; ++k) {
    const double time = duration * k / samples;
    curves["time"].push_back(time);
    curves["distance"].push_back(gap(time));
    curves["psi"].push_back(psi(time));
  }
  return curves;
}

}  // namespace vitrel::bench
