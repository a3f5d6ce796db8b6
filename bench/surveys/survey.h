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

/// A method, and the time that it may take for the predictions of all classes together. Its rows describe what it
/// answers in that time. Without a limit it answers every pair.
template <int Dim>
struct CandidateOf {
  MethodOf<Dim> method;
  double seconds = std::numeric_limits<double>::infinity();
};

template <int Dim>
struct SurveyRequestOf {
  std::vector<CandidateOf<Dim>> candidates;
  std::vector<CaseClassOf<Dim>> classes;
  std::uint64_t pairs = 1000;  ///< in each class
  std::uint64_t seed = 1;
  AllowedError tolerance;
};

/// The results of one method on one class. Errors are NaN if no pair defines them.
struct SurveyRow {
  std::string method;
  double tolerance = 0;    ///< of the method
  std::string case_class;  ///< name of the class
  double aspect_ratio = 0;
  std::uint64_t pairs = 0;
  /// The number of pairs with each verdict.
  std::array<std::uint64_t, verdict_names.size()> verdicts{};
  std::uint64_t degenerate = 0;
  std::uint64_t contacts = 0;  ///< pairs that really touch within the horizon
  double ns_per_call = 0;
  /// |reported − true time| as a fraction of the horizon, for the pairs that are not degenerate and have both a true
  /// and a reported contact.
  double largest_error = 0, median_error = 0;
  /// |true gap at the reported time| in units of the smallest semi-axis, for all pairs with a contact.
  double largest_gap_error = 0;
  /// |true gap at the reported time| in units of the contact gap (collision_case.h), for all pairs with a reported
  /// contact whose true time is ill-defined (degenerate) or does not exist. It tells how far these answers are from
  /// being right.
  double largest_moot_gap = 0;

  std::uint64_t count(Verdict of) const { return verdicts[static_cast<std::size_t>(of)]; }
  /// Whether the method answers any pair at all; if not, it is not made for such pairs.
  bool applies() const { return count(Verdict::not_converged) < pairs; }
};

/// A pair on which a method failed, for a picture.
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
  std::vector<SurveyRow> rows;  ///< sorted by class, then by method in the order of the request
  std::vector<FailingCaseOf<Dim>> failures;  ///< at most one per method
  bool stopped = false;  ///< true if the survey stopped before all pairs were done
};

using Candidate = CandidateOf<2>;
using SurveyRequest = SurveyRequestOf<2>;
using FailingCase = FailingCaseOf<2>;
using Survey = SurveyOf<2>;

/// Lets every method answer the same pairs, compares the answers with the reference, and times the methods without
/// the reference. Of the failures of a method, the first of the gravest kind is kept: late or missed is graver than
/// early or false, then follow failures on degenerate pairs, and last missing answers, unless the method does not
/// apply.
template <int Dim = 2>
SurveyOf<Dim> survey(const SurveyRequestOf<Dim>& request, const RunControl& control);

}  // namespace vitrel::bench
