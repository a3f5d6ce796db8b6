// Which overlap test is right, and what does it cost?

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/overlap/limited_search.h"
#include "bench/overlap/overlap_case.h"
#include "bench/overlap/polygon.h"
#include "bench/studies/choice.h"
#include "bench/studies/study.h"
#include "bench/surveys/timed_batches.h"
#include "core/contact/contact_queries.h"
#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/ellipsoid_eta.h"
#include "core/contact/perram_wertheim.h"

namespace vitrel::bench {
namespace {

/// Pairs whose gap is smaller, in gap units, are left out, because positions and semi-axes in double precision do not
/// determine such a gap, so that two right criteria may differ.
constexpr double smallest_judged_gap = 1e-13;

/// A criterion that tells whether two bodies are disjoint. Every criterion is given positions and orientations, so
/// its time includes the sines and cosines.
template <int Dim>
struct Criterion {
  std::string name;
  std::function<bool(const OverlapCase<Dim>&)> disjoint;
  std::string curve = {};  ///< common to criteria that differ in one number
};

VieillardBaron<double> contact_function(const OverlapCase<2>& asked) {
  return vieillard_baron(asked.one, asked.pose1.angle, asked.two, asked.pose2.angle,
                         asked.between_centres());
}

EllipsoidEta<double> signs(const OverlapCase<3>& asked) {
  return ellipsoid_eta(asked.one, asked.pose1.orientation, asked.two, asked.pose2.orientation,
                       asked.between_centres());
}

template <int Dim>
bool by_separating_axis(const OverlapCase<Dim>& asked) {
  return separated(asked.one, asked.pose1, asked.two, asked.pose2, asked.between_centres(), 0);
}

template <int Dim>
bool by_perram_wertheim(const OverlapCase<Dim>& asked) {
  return perram_wertheim(asked.one, orientation_of(asked.pose1), asked.two,
                         orientation_of(asked.pose2), asked.between_centres())
      .disjoint();
}

template <int Dim>
void add_limited_searches(std::vector<Criterion<Dim>>& all) {
  for (int steps = 4; steps <= 64; steps *= 2)
    all.push_back(
        {fmt::format("undecided_is_disjoint_{}", steps),
         [steps](const OverlapCase<Dim>& asked) { return disjoint_or_undecided(asked, steps); },
         "undecided_is_disjoint"});
}

std::vector<Criterion<2>> criteria(std::integral_constant<int, 2>) {
  std::vector<Criterion<2>> all = {
      {"separating_axis", by_separating_axis<2>},
      {"perram_wertheim", by_perram_wertheim<2>},
      {"vieillard_baron",
       [](const OverlapCase<2>& asked) { return contact_function(asked).disjoint(); }},
      {"vieillard_baron_as_in_the_thesis",
       [](const OverlapCase<2>& asked) { return contact_function(asked).psi > 0; }}};
  for (int vertices = 8; vertices <= 256; vertices *= 2)
    all.push_back({"polygon_" + std::to_string(vertices),
                   [shape = RegularPolygon(vertices)](const OverlapCase<2>& asked) {
                     return disjoint(shape, asked);
                   },
                   "polygons"});
  add_limited_searches(all);
  return all;
}

std::vector<Criterion<3>> criteria(std::integral_constant<int, 3>) {
  std::vector<Criterion<3>> all = {
      {"separating_axis", by_separating_axis<3>},
      {"perram_wertheim", by_perram_wertheim<3>},
      {"eta_signs", [](const OverlapCase<3>& asked) { return signs(asked).disjoint(); }},
      {"eta_signs_as_printed", [](const OverlapCase<3>& asked) {
         const EllipsoidEta<double> of = signs(asked);
         return of.eta1 > 0 && of.eta2 > 0 && of.eta5 > 0;
       }}};
  add_limited_searches(all);
  return all;
}

template <int Dim>
struct Asked {
  std::vector<OverlapCase<Dim>> cases;
  std::vector<OverlapTruth> truths;
};

template <int Dim>
Asked<Dim> make_cases(const StudyOptions& options, const OverlapClass& of) {
  Asked<Dim> asked;
  for (std::uint64_t k = 0; k < options.pairs; ++k) {
    const OverlapCase<Dim> one = make_overlap_case<Dim>(of, options.seed, k);
    const OverlapTruth truth = true_overlap(one);
    if (std::abs(truth.gap) < smallest_judged_gap * one.gap_unit()) continue;
    asked.cases.push_back(one);
    asked.truths.push_back(truth);
  }
  return asked;
}

/// Measures a criterion. A slow one answers as many pairs as its time allows.
template <int Dim>
Json examined(const Criterion<Dim>& criterion, const OverlapClass& of, const Asked<Dim>& asked,
              double seconds) {
  std::uint64_t wrong_overlap = 0, wrong_disjoint = 0;
  double largest_gap = 0;
  TimedBatches timer(seconds);
  std::vector<char> answers(asked.cases.size());
  std::size_t done = 0;
  while (const std::size_t batch = timer.next(asked.cases.size() - done)) {
    timer.run(batch, [&] {
      for (std::size_t k = done; k < done + batch; ++k)
        answers[k] = static_cast<char>(criterion.disjoint(asked.cases[k]));
    });
    for (std::size_t k = done; k < done + batch; ++k) {
      if ((answers[k] != 0) == asked.truths[k].disjoint) continue;
      ++(answers[k] ? wrong_disjoint : wrong_overlap);
      largest_gap =
          std::max(largest_gap, std::abs(asked.truths[k].gap) / asked.cases[k].gap_unit());
    }
    done += batch;
  }
  Json row = {{"method", criterion.name}, {"class", of.name}, {"aspect_ratio", of.aspect_ratio}};
  if (!criterion.curve.empty()) row["curve"] = criterion.curve;
  row.update({{"pairs", done},
              {"wrong_overlap", wrong_overlap},
              {"wrong_disjoint", wrong_disjoint},
              {"largest_wrong_gap", largest_gap},
              {"ns_per_call", timer.ns_per_call()}});
  return row;
}

template <int Dim>
Json measure(const StudyContext& context) {
  const auto classes = selected(overlap_classes<Dim>(), context.options.classes);
  const auto methods =
      selected(criteria(std::integral_constant<int, Dim>()), context.options.methods);
  Json rows = Json::array();
  for (std::size_t k = 0; k < classes.size() && !context.control.stop_requested(); ++k) {
    const Asked<Dim> asked = make_cases<Dim>(context.options, classes[k]);
    const auto count = static_cast<double>(classes.size()), done = static_cast<double>(k + 1);
    for (const Criterion<Dim>& criterion : methods)
      rows.push_back(examined(criterion, classes[k], asked, context.options.seconds / count));
    context.control.report_progress({done / count, done, "classes"});
  }
  return rows;
}

template <int Dim>
Part part(const std::string& name, const std::string& about) {
  return {
      .name = name,
      .about = about,
      .measure = measure<Dim>,
      .cases = {{"class"}, {"aspect_ratio", "κ"}},
      .cost = {"ns_per_call", "time per test", Shown::time},
      .error = {"largest_wrong_gap", "largest wrong gap", Shown::error, "shortest semi-axes"},
      .verdicts = {{"wrong_overlap", "called overlapping"}, {"wrong_disjoint", "called disjoint"}},
      .method_names = names_of(criteria(std::integral_constant<int, Dim>())),
      .class_names = names_of(overlap_classes<Dim>()),
      .smallest_error = smallest_judged_gap};
}

}  // namespace

Study overlap_study() {
  return {
      .name = "overlap",
      .aliases = {},
      .question = "Which overlap test is right, and what does it cost?",
      .parts = {part<2>("plane",
                        "Pairs of ellipses: anywhere, near contact, and grazing down to gaps of "
                        "10⁻¹². The truth is the complete criterion of Vieillard-Baron in 80-bit "
                        "arithmetic. The thesis has Ψ > 0 alone, which calls crossed and nested "
                        "ellipses disjoint. Polygons have the area of their ellipses."),
                part<3>("space",
                        "The same of ellipsoids. The truth is the completed criterion of the "
                        "signs of η in 80-bit arithmetic; as printed it calls crossed and nested "
                        "ellipsoids disjoint.")},
      .defaults = {.pairs = 20000, .seconds = 1},
      .has_quick = false};
}

}  // namespace vitrel::bench
