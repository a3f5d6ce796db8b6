#include "bench/baselines/method_engine.h"

#include <limits>

#include "bench/baselines/no_lower_bound.h"
#include "bench/baselines/unchecked_method.h"
#include "bench/methods/bracket.h"
#include "core/contact/contact_queries.h"
#include "edmd/simulation.h"

namespace vitrel::bench {
namespace {

/// An ellipse whose collisions are predicted by the method of the engine that runs in this thread.
struct PredictedEllipse : Ellipse {
  static thread_local const Method* method;
};
thread_local const Method* PredictedEllipse::method = nullptr;

}  // namespace
}  // namespace vitrel::bench

namespace vitrel {

template <>
struct ShapeOf<bench::PredictedEllipse> : ShapeOf<Ellipse> {};

/// The screen excludes no pair, so that the method predicts every pair.
template <>
class ContactScreen<bench::PredictedEllipse> : public bench::NoLowerBound<bench::PredictedEllipse> {
 public:
  using NoLowerBound<bench::PredictedEllipse>::NoLowerBound;
};

}  // namespace vitrel

namespace vitrel::bench {
namespace {

// Simulation<PredictedEllipse> finds this function in place of the default predictor. If the method has no answer,
// there is no contact.
Prediction2 first_contact(const Flight<PredictedEllipse>& one, const Flight<PredictedEllipse>& two,
                          double horizon, double /*contact_gap*/, double /*screened_until*/,
                          const WarmStart<PredictedEllipse>& /*warm_start*/) {
  const auto plain = [](const Flight<PredictedEllipse>& flight) {
    return of_constant_size({flight.body, flight.pose, flight.motion});
  };
  const Prediction2 answer =
      unchecked_answer(*PredictedEllipse::method, {plain(one), plain(two), horizon});
  return answer.outcome == Outcome::not_converged ? Prediction2{} : answer;
}

}  // namespace

std::unique_ptr<Engine2> make_method_engine(const Method& method, const EngineOptions& options) {
  PredictedEllipse::method = &method;
  return std::make_unique<Simulation<PredictedEllipse>>(options,
                                                        "ellipses, collisions by " + method.name);
}

std::vector<CollisionCase> recorded_cases(const Configuration2& start, std::size_t count) {
  std::vector<CollisionCase> cases;
  const Method recording{"recording", 0, [&](const CollisionCase& asked) {
                           if (cases.size() < count && bracket_contact(asked))
                             cases.push_back(asked);
                           return vitrel::first_contact(asked.one, asked.two, asked.horizon,
                                                        asked.contact_gap());
                         }};
  const auto engine = make_method_engine(recording, {});
  Configuration2 now = start;
  RunCounters counters;
  engine->load(now, Engine2::never);
  while (cases.size() < count) {
    engine->advance(std::numeric_limits<double>::max(), counters);
    engine->write(now);
    engine->load(now, Engine2::never);
  }
  return cases;
}

}  // namespace vitrel::bench
