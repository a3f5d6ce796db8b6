#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/workflow/bench/chart.h"
#include "bench/lab/survey.h"

/// `vitrel bench collision-time` and `collision-time-of-solids`: every method of predicting a collision of
/// ellipses or ellipsoids, asked about the same pairs.
namespace vitrel {

struct CollisionTimeRequest {
  std::uint64_t pairs = 2000;  ///< of each class
  double seconds = 4;          ///< that a method other than the default may predict
  std::uint64_t seed = 1;
  lab::JudgingTolerance tolerance;
  std::vector<std::string> methods;  ///< by name; empty: all
  std::vector<std::string> classes;  ///< likewise
  bool with_chart = false;           ///< measure every method at all its tolerances, too
};

/// In the chart a coarse answer counts as correct if it is off by no more than this.
inline constexpr double charted_tolerance = 1e-2;

template <int Dim>
struct CollisionTimeBenchOf {
  lab::SurveyOf<Dim> survey;  ///< every method at its usual tolerance
  /// Every tolerance, on the generic class, judged by `charted_tolerance`.
  std::vector<lab::SurveyRow> tolerances;
  bool stopped = false;
};
using CollisionTimeBench = CollisionTimeBenchOf<2>;

using Say = std::function<void(const std::string&)>;

/// Throws UserError for an unknown method or class.
CollisionTimeBench bench_collision_time(const CollisionTimeRequest& request,
                                        const RunControl& control, const Say& say);
CollisionTimeBenchOf<3> bench_collision_time_of_solids(const CollisionTimeRequest& request,
                                                       const RunControl& control, const Say& say);

nlohmann::ordered_json collision_time_json(const std::vector<lab::SurveyRow>& rows);

/// The rows as lines, grouped by method, with the counts of wrong and of degenerate answers and the
/// largest errors of time and gap; "·" stands for 0.
std::string collision_time_text(const std::vector<lab::SurveyRow>& rows);

/// Time per call against the median or the largest error, a point per method and tolerance.
enum class ChartedError { median, largest };
Chart speed_chart(const std::vector<lab::SurveyRow>& rows, ChartedError error);

}  // namespace vitrel
