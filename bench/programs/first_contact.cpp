// What does a prediction of the default method cost, and where?
//
// Time of first_contact (core/contact) on the pairs of one class, the best of several repetitions.
// scripts/count_instructions runs this program to count instructions by function.

#include <fmt/format.h>

#include <type_traits>
#include <vector>

#include "app/terminal/session.h"
#include "bench/programs/programs.h"
#include "bench/surveys/best_seconds.h"
#include "bench/surveys/recorded_class.h"
#include "core/contact/first_contact.h"
#include "core/error.h"

namespace vitrel::bench {
namespace {

CaseClass class_of(const FirstContactOptions& options) {
  std::string known;
  for (const CaseClass& of : all_classes()) {
    if (of.name == options.name && of.aspect_ratio == options.aspect_ratio) return of;
    known += fmt::format("\n  {} {}", of.name, of.aspect_ratio);
  }
  throw UserError(fmt::format("no class '{}' with aspect ratio {}; there are:{}", options.name,
                              options.aspect_ratio, known));
}

template <class B>
struct Question {
  Flight<B> one, two;
  double horizon, contact_gap;
};

// As the engine asks: bodies of constant size are plain ellipses.
template <class B>
Flight<B> as(const Flight<GrowingEllipse>& flight) {
  if constexpr (std::is_same_v<B, Ellipse>)
    return {flight.body.at(0), flight.pose, flight.motion};
  else
    return flight;
}

template <class B>
std::vector<Question<B>> questions_about(const std::vector<CollisionCase>& cases) {
  std::vector<Question<B>> questions;
  for (const CollisionCase& of : cases)
    questions.push_back({as<B>(of.one), as<B>(of.two), of.horizon, of.contact_gap()});
  return questions;
}

// A function of its own, so that callgrind can count it alone.
template <class B>
[[gnu::noinline]] void answer_all(const std::vector<Question<B>>& questions,
                                  std::vector<Prediction2>& answers) {
  for (std::size_t k = 0; k < questions.size(); ++k) {
    const Question<B>& asked = questions[k];
    answers[k] = first_contact(asked.one, asked.two, asked.horizon, asked.contact_gap);
  }
}

template <class B>
void measure(const FirstContactOptions& options, const std::vector<CollisionCase>& cases) {
  const auto questions = questions_about<B>(cases);
  std::vector<Prediction2> answers(questions.size());
  const double best = best_seconds(options.repeats, [&] { answer_all(questions, answers); });
  double steps = 0, contacts = 0;
  for (const Prediction2& answer : answers) {
    steps += answer.steps;
    contacts += answer.outcome == Outcome::contact;
  }
  const auto count = static_cast<double>(answers.size());
  print_text(fmt::format("{} {}: {:.1f} ns per prediction, {:.2f} steps, {:.1f} % contacts\n",
                         options.name, options.aspect_ratio, 1e9 * best / count, steps / count,
                         100 * contacts / count));
}

}  // namespace

int first_contact_time(const FirstContactOptions& options) {
  const CaseClass of = class_of(options);
  constexpr std::uint64_t seed = 1;
  std::vector<CollisionCase> cases;
  bool grows = false;
  for (std::uint64_t index = 0; index < options.pairs; ++index) {
    cases.push_back(make_case(of, seed, index));
    grows = grows || cases.back().grows();
  }
  if (grows)
    measure<GrowingEllipse>(options, cases);
  else
    measure<Ellipse>(options, cases);
  return 0;
}

}  // namespace vitrel::bench
