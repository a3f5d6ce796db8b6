#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bench/methods/method.h"
#include "bench/surveys/stability_suite.h"
#include "bench/surveys/verdict.h"
#include "core/state/stage.h"

namespace vitrel::bench {

/// A method and how long it may predict, all classes together; what it answers in that time is what
/// its rows are about. Without a limit it answers every pair.
template <int Dim>
struct CandidateOf {
  MethodOf<Dim> method;
  double seconds = std::numeric_limits<double>::infinity();
};

template <int Dim>
struct SurveyRequestOf {
  std::vector<CandidateOf<Dim>> candidates;
  std::vector<CaseClassOf<Dim>> classes;
  std::uint64_t pairs = 1000;  ///< of each class
  std::uint64_t seed = 1;
  AllowedError tolerance;
};

/// One method on one class. Errors are NaN if there is no pair to take them from.
struct SurveyRow {
  std::string method;
  double tolerance = 0;    ///< the method's own
  std::string case_class;  ///< its name
  double aspect_ratio = 0;
  std::uint64_t pairs = 0;
  std::array<std::uint64_t, verdict_names.size()> verdicts{};  ///< how many pairs had which
  std::uint64_t degenerate = 0;
  std::uint64_t contacts = 0;  ///< pairs that truly touch within the horizon
  double ns_per_call = 0;
  /// |reported − true time| as a fraction of the horizon, of the pairs that are not degenerate and
  /// for which both report a contact.
  double largest_error = 0, median_error = 0;
  /// |true gap at the reported time| in units of the smallest semi-axis, of all pairs with a
  /// contact.
  double largest_gap_error = 0;
  /// |true gap at the reported time| in units of the contact gap (collision_case.h), of all pairs
  /// with a reported contact whose true time is ill-defined (degenerate) or does not exist: how
  /// far these answers are from being right.
  double largest_moot_gap = 0;

  std::uint64_t count(Verdict of) const { return verdicts[static_cast<std::size_t>(of)]; }
  /// Not one answer: the method is not made for such pairs.
  bool applies() const { return count(Verdict::not_converged) < pairs; }
};

/// A pair that a method failed on, for a picture.
template <int Dim>
struct FailingCaseOf {
  std::string method;
  CaseClassOf<Dim> case_class;
  std::uint64_t index = 0;
  CollisionCaseOf<Dim> asked;
  TrueContactOf<Dim> truth;
  Prediction<Dim> answer;
  Assessment assessment;
};

template <int Dim>
struct SurveyOf {
  std::vector<SurveyRow> rows;  ///< class by class, methods in the order of the request
  std::vector<FailingCaseOf<Dim>> failures;  ///< at most one per method
  bool stopped = false;                      ///< before all pairs were done
};

using Candidate = CandidateOf<2>;
using SurveyRequest = SurveyRequestOf<2>;
using FailingCase = FailingCaseOf<2>;
using Survey = SurveyOf<2>;

/// Asks every method about the same pairs, compares the answers with the reference and times
/// the methods, the reference's time apart. Of a method's failures the first of the gravest kind is
/// kept: late or missed, then early or false, these if the pair is degenerate, and last no answer,
/// unless the method does not apply.
template <int Dim = 2>
SurveyOf<Dim> survey(const SurveyRequestOf<Dim>& request, const RunControl& control);

}  // namespace vitrel::bench
