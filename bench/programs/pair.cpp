#include "bench/programs/pair.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/terminal/exit_codes.h"
#include "app/terminal/session.h"
#include "bench/methods/method.h"
#include "bench/studies/choice.h"
#include "bench/studies/tables.h"
#include "bench/surveys/timed_batches.h"
#include "core/io/json.h"
#include "workflow/pair/pair.h"

namespace vitrel::bench {
namespace {

/// The answer of a method, and the time it takes.
struct Answer {
  std::string method;
  double tolerance;
  Outcome outcome;
  double time;  ///< NaN if there is no contact
  double ns_per_call;
};

const char* outcome_text(Outcome outcome) {
  switch (outcome) {
    case Outcome::contact:
      return "contact";
    case Outcome::none:
      return "no contact";
    case Outcome::overlap:
      return "overlap";
    case Outcome::not_converged:
      break;
  }
  return "no answer";
}

template <class Shape>
Flight<Growing<Shape>> of_size_one(const Flight<Shape>& flight) {
  return {{flight.body, 1, 0}, flight.pose, flight.motion};
}

template <int Dim>
CollisionCaseOf<Dim> case_of(const Pair<Dim>& pair) {
  CollisionCaseOf<Dim> asked{of_size_one(pair.one), of_size_one(pair.two), pair.horizon};
  if constexpr (Dim == 3)
    if (pair.tumbles()) let_tumble(asked);
  return asked;
}

template <class Ask>
double ns_per_call(Ask&& ask) {
  constexpr double seconds = 0.1;
  TimedBatches batches(seconds);
  while (const std::size_t count = batches.next(std::numeric_limits<std::size_t>::max()))
    batches.run(count, [&] {
      for (std::size_t k = 0; k < count; ++k) ask();
    });
  return batches.ns_per_call();
}

template <int Dim>
Answer ask(const MethodOf<Dim>& method, const Pair<Dim>& pair) {
  PairContact<Dim> found;
  const auto predict = [&](const Pair<Dim>& alone) { return method.predict(case_of(alone)); };
  const double ns = ns_per_call([&] { found = first_contact_of_images<Dim>(pair, predict); });
  const Prediction<Dim>& prediction = found.prediction;
  const bool is_contact = prediction.outcome == Outcome::contact;
  return {method.name, method.tolerance, prediction.outcome, is_contact ? prediction.time : NAN,
          ns};
}

/// Whether the bodies overlap at the start.
template <int Dim>
Json overlap_json(const Pair<Dim>& pair) {
  bool found = false;
  const double ns = ns_per_call([&] { found = overlaps(pair); });
  return {{"found", found}, {"ns_per_call", ns}};
}

/// The answers of the methods. The default method comes first, whether it is requested or not.
template <int Dim>
std::vector<Answer> answers(const Pair<Dim>& pair, const std::vector<std::string>& names) {
  const auto all = collision_time_methods<Dim>();
  std::vector<Answer> found = {ask(all.front(), pair)};
  for (const MethodOf<Dim>& method : chosen(all, names, "method"))
    if (method.name != all.front().name) found.push_back(ask(method, pair));
  return found;
}

/// The number; null if it is NaN.
Json number(double value) {
  return std::isnan(value) ? Json(nullptr) : Json(value);
}

Json rows_json(const std::vector<Answer>& answers) {
  Json rows = Json::array();
  for (const Answer& of : answers)
    rows.push_back({{"method", of.method},
                    {"tolerance", of.tolerance},
                    {"outcome", outcome_text(of.outcome)},
                    {"time", number(of.time)},
                    {"difference", number(of.time - answers.front().time)},
                    {"ns_per_call", of.ns_per_call}});
  return rows;
}

std::string rows_text(const std::vector<Answer>& answers) {
  constexpr const char* line = "{:<22} {:<12} {:<20} {:>12} {:>10}\n";
  std::string text =
      fmt::format(fmt::runtime(line), "method", "outcome", "time", "difference", "per call");
  for (const Answer& of : answers) {
    const bool is_contact = !std::isnan(of.time);
    const double difference = of.time - answers.front().time;
    text += fmt::format(fmt::runtime(line), of.method, outcome_text(of.outcome),
                        is_contact ? fmt::format("{:.15g}", of.time) : "–", error_text(difference),
                        time_text(of.ns_per_call));
  }
  return text;
}

template <int Dim>
void answer(const Pair<Dim>& pair, const std::vector<std::string>& names,
            const OutputOptions& output) {
  const std::vector<Answer> found = answers(pair, names);
  if (output.json)
    print_text(json_text({{"rows", rows_json(found)}, {"overlap", overlap_json(pair)}}, 2) + '\n');
  else if (!output.quiet)
    print_text(rows_text(found));
}

}  // namespace

int pair(const PairMethodsOptions& options, const OutputOptions& output) {
  const PairParameters parameters = parse_pair(options.pair, "pair");
  if (parameters.dimension() == 2)
    answer(pair_of<2>(parameters), options.methods, output);
  else
    answer(pair_of<3>(parameters), options.methods, output);
  return success;
}

}  // namespace vitrel::bench
