#include "bench/surveys/thesis_scene.h"

#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "bench/methods/method.h"
#include "bench/reference/first_contact.h"
#include "core/io/json.h"

namespace vitrel::bench {
namespace {

const Flight<Ellipse> resting{{1, 0.5}, {{0, 0}, 0}, {{0, 0}, 0}};
const Flight<Ellipse> coming{{1, 0.5}, {{1, 1}, 0}, {{-1, 0}, std::numbers::pi}};
constexpr double duration = 2;

struct Answer {
  std::string method;
  double tolerance;
  std::optional<double> time;
};

std::vector<Answer> answers() {
  const CollisionCase asked{of_constant_size(resting), of_constant_size(coming), duration};
  std::vector<Answer> list = {
      {"reference", 0, static_cast<double>(true_first_contact(resting, coming, duration).time)}};
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

}  // namespace vitrel::bench
