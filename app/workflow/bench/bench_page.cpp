#include "app/workflow/bench/bench_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/workflow/bench/figures.h"
#include "app/workflow/bench/overlap.h"
#include "app/workflow/bench/picture.h"
#include "app/workflow/bench/scene.h"
#include "app/workflow/bench/svg.h"
#include "app/workflow/bench/whole_run.h"
#include "bench/lab/recorded_class.h"
#include "workflow/report/assets.h"
#include "workflow/report/html.h"

namespace vitrel {
namespace {

using lab::CaseClass;
using lab::FailingCase;
using lab::OverlapRow;
using lab::SurveyRow;
using lab::WholeRun;

const char* const style = R"(
section svg { max-width: 100%; height: auto; display: block; }
section > figure { margin: 0 0 1.2rem; overflow-x: auto; }
section > figure:last-child { margin-bottom: 0; }
figcaption { max-width: 62rem; }
th[scope="row"], td.words, thead th:first-child { text-align: left; }
thead th { border-bottom: 1px solid var(--line); padding-bottom: .3rem; white-space: normal; }
th:last-child, td:last-child { text-align: right; }
td.words:last-child, th.words:last-child { text-align: left; }
table.matrix thead th { font-weight: 500; font-size: .82rem; line-height: 1.25; }
td.some { background: color-mix(in srgb, #d9822b 18%, transparent); }
td.many { background: color-mix(in srgb, #d9822b 42%, transparent); }
td.most { background: color-mix(in srgb, #c8374d 50%, transparent); }
details { margin-top: .4rem; }
details > .scroll { margin: .3rem 0 .8rem; }
td.words { white-space: normal; min-width: 16rem; color: var(--quiet); }
)";

std::string section(const std::string& id, const std::string& heading, const std::string& content) {
  return fmt::format(
      "<section aria-labelledby=\"{0}\">\n<h2 id=\"{0}\">{1}</h2>\n{2}</section>\n\n", id, heading,
      content);
}

std::string paragraph(const std::string& text) {
  return "<p>" + text + "</p>\n";
}

std::string figure(const std::string& svg, const std::string& caption = "") {
  return "<figure>\n" + svg +
         (caption.empty() ? "" : "<figcaption>" + escaped(caption) + "</figcaption>\n") +
         "</figure>\n";
}

std::string table(const std::string& kind, const std::vector<std::string>& headings,
                  const std::string& rows) {
  std::string text = "<div class=\"scroll\" tabindex=\"0\"><table" +
                     (kind.empty() ? "" : " class=\"" + kind + "\"") + ">\n<thead><tr>";
  for (const std::string& heading : headings) text += "<th scope=\"col\">" + heading + "</th>";
  return text + "</tr></thead>\n<tbody>\n" + rows + "</tbody>\n</table></div>\n";
}

std::string row_heading(const std::string& text) {
  return "<tr><th scope=\"row\">" + escaped(text) + "</th>";
}

std::string cell(const std::string& text) {
  return "<td>" + text + "</td>";
}

/// A share of failures, coloured by how large it is.
std::string failure_cell(std::uint64_t part, std::uint64_t whole, const std::string& note) {
  const double share = static_cast<double>(part) / static_cast<double>(whole);
  const char* tint = part == 0      ? ""
                     : share < 0.01 ? " class=\"some\""
                     : share < 0.1  ? " class=\"many\""
                                    : " class=\"most\"";
  return fmt::format("<td{} title=\"{}\">{}</td>", tint, escaped(note), share_text(part, whole));
}

/// The name with breaks where a line may end.
std::string breakable(const std::string& name) {
  std::string text;
  for (const char c : escaped(name)) text += c == '_' ? std::string("_<wbr>") : std::string(1, c);
  return text;
}

template <class Row>
std::vector<std::string> method_names(const std::vector<Row>& rows) {
  std::vector<std::string> names;
  for (const Row& row : rows)
    if (!std::ranges::count(names, row.method)) names.push_back(row.method);
  return names;
}

std::string class_name(const std::string& name, double aspect_ratio) {
  return fmt::format("{}, κ = {:g}", name, aspect_ratio);
}

const SurveyRow* generic_row(const std::vector<SurveyRow>& rows, const std::string& method,
                             double aspect_ratio) {
  const auto found = std::ranges::find_if(rows, [&](const SurveyRow& row) {
    return row.method == method && row.case_class == "generic" && row.aspect_ratio == aspect_ratio;
  });
  return found == rows.end() ? nullptr : &*found;
}

std::vector<double> generic_aspect_ratios(const std::vector<SurveyRow>& rows) {
  std::vector<double> ratios;
  for (const SurveyRow& row : rows)
    if (row.case_class == "generic" && !std::ranges::count(ratios, row.aspect_ratio))
      ratios.push_back(row.aspect_ratio);
  return ratios;
}

/// Time per call and how many times that of the first method it is.
std::string speed_cells(const std::vector<SurveyRow>& rows, const std::string& method,
                        const std::string& first, double aspect_ratio) {
  const SurveyRow* row = generic_row(rows, method, aspect_ratio);
  const SurveyRow* reference = generic_row(rows, first, aspect_ratio);
  if (!row || !reference || !row->applies()) return cell("–") + cell("–");
  return cell(time_text(row->ns_per_call)) +
         cell(ratio_text(row->ns_per_call / reference->ns_per_call));
}

std::string glance(const std::vector<SurveyRow>& rows) {
  const std::vector<std::string> methods = method_names(rows);
  const std::vector<double> ratios = generic_aspect_ratios(rows);
  std::vector<std::string> headings = {"method"};
  for (const double ratio : ratios) {
    headings.push_back(fmt::format("per call, κ = {:g}", ratio));
    headings.push_back("× first row");
  }
  for (const char* const name :
       {"pairs", "late", "missed", "early", "false", "no answer", "largest error"})
    headings.emplace_back(name);
  std::string text;
  for (const std::string& method : methods) {
    SurveyRow sum;
    sum.largest_error = std::numeric_limits<double>::quiet_NaN();
    for (const SurveyRow& row : rows) {
      if (row.method != method || !row.applies()) continue;
      sum.pairs += row.pairs, sum.late += row.late, sum.missed += row.missed;
      sum.early += row.early, sum.false_contacts += row.false_contacts;
      sum.not_converged += row.not_converged;
      sum.largest_error = std::fmax(sum.largest_error, row.largest_error);
    }
    if (sum.pairs == 0) continue;
    text += row_heading(method);
    for (const double ratio : ratios) text += speed_cells(rows, method, methods.front(), ratio);
    text += cell(std::to_string(sum.pairs));
    for (const std::uint64_t count :
         {sum.late, sum.missed, sum.early, sum.false_contacts, sum.not_converged})
      text += failure_cell(count, sum.pairs, fmt::format("{} of {}", count, sum.pairs));
    text += cell(error_text(sum.largest_error)) + "</tr>\n";
  }
  return table("", headings, text);
}

/// Share of wrong answers: a row per class, a column per method.
std::string stability_matrix(const std::vector<SurveyRow>& rows) {
  const std::vector<std::string> methods = method_names(rows);
  std::vector<std::string> headings = {"class"};
  for (const std::string& method : methods) headings.push_back(breakable(method));
  std::vector<std::pair<std::string, double>> classes;
  for (const SurveyRow& row : rows)
    if (!std::ranges::count(classes, std::pair(row.case_class, row.aspect_ratio)))
      classes.emplace_back(row.case_class, row.aspect_ratio);
  std::string text;
  for (const auto& [name, ratio] : classes) {
    text += row_heading(class_name(name, ratio));
    for (const std::string& method : methods) {
      const auto row = std::ranges::find_if(rows, [&](const SurveyRow& r) {
        return r.method == method && r.case_class == name && r.aspect_ratio == ratio;
      });
      text += row == rows.end() || !row->applies()
                  ? cell("–")
                  : failure_cell(row->wrong(), row->pairs,
                                 fmt::format("{} pairs: {} early, {} late, {} missed, {} false, "
                                             "{} without an answer",
                                             row->pairs, row->early, row->late, row->missed,
                                             row->false_contacts, row->not_converged));
    }
    text += "</tr>\n";
  }
  return table("matrix", headings, text);
}

std::string method_details(const std::vector<SurveyRow>& rows, const std::string& method) {
  std::string text;
  double tolerance = 0;
  for (const SurveyRow& row : rows) {
    if (row.method != method) continue;
    tolerance = row.tolerance;
    text += row_heading(class_name(row.case_class, row.aspect_ratio)) +
            cell(std::to_string(row.pairs)) + cell(count_text(row.correct));
    for (const std::uint64_t count :
         {row.early, row.late, row.missed, row.false_contacts, row.not_converged})
      text += count == 0 ? cell("·")
                         : fmt::format("<td class=\"{}\">{}</td>",
                                       10 * count < row.pairs ? "many" : "most", count);
    text += cell(count_text(row.degenerate)) + cell(time_text(row.ns_per_call)) +
            cell(error_text(row.largest_error)) + cell(error_text(row.median_error)) +
            cell(error_text(row.largest_gap_error)) + "</tr>\n";
  }
  return fmt::format(
      "<details><summary>{}, tolerance {:.2g}</summary>\n{}</details>\n", escaped(method),
      tolerance,
      table("",
            {"class", "pairs", "correct", "early", "late", "missed", "false", "no answer",
             "degenerate", "per call", "largest error", "median error", "gap error"},
            text));
}

std::string stability(const std::vector<SurveyRow>& rows) {
  std::string text =
      paragraph(
          "Share of the pairs that a method does not answer correctly. Point at a number "
          "for the kinds of failures; below are all counts, method by method. “–”: the method "
          "answers no pair of the class.") +
      stability_matrix(rows);
  for (const std::string& method : method_names(rows)) text += method_details(rows, method);
  std::string classes;
  for (const CaseClass& of : lab::all_classes())
    if (std::ranges::count(rows, of.name, &SurveyRow::case_class))
      classes += row_heading(class_name(of.name, of.aspect_ratio)) + "<td class=\"words\">" +
                 escaped(of.meaning) + "</td></tr>\n";
  return text + "<details><summary>What the classes are</summary>\n" +
         table("", {"class", "meaning"}, classes) + "</details>\n" +
         "<p class=\"note\">Early, late: the time is off by more than the judge's tolerance. "
         "Missed: a contact exists, none is reported. False: a contact is reported, but the true "
         "gap never becomes that small. Errors of time are fractions of the horizon and leave out "
         "degenerate pairs, whose surfaces cross so slowly that a gap of the size of rounding is "
         "a long time; gap errors are in semi-minor axes.</p>\n";
}

std::string failures(const std::vector<FailingCase>& cases) {
  std::string text = paragraph(
      "A pair that each method answers wrongly: the first one late or missed, if there is "
      "any. Blue is body 1, orange body 2, "
      "overlap red; the arrow is the motion of body 2 as body 1 sees it. Each picture "
      "has its own scale.");
  for (const FailingCase& failure : cases)
    text +=
        "<h3>" + escaped(failure.method) + "</h3>\n" +
        figure(failure_svg(failure),
               fmt::format("{} {} (class {}, pair {}).", failure.method, failure_caption(failure),
                           class_name(failure.case_class.name, failure.case_class.aspect_ratio),
                           failure.index));
  return text;
}

std::string overlap_section(const std::vector<OverlapRow>& rows) {
  const std::vector<std::string> methods = method_names(rows);
  std::vector<std::pair<std::string, double>> classes;
  for (const OverlapRow& row : rows)
    if (!std::ranges::count(classes, std::pair(row.case_class, row.aspect_ratio)))
      classes.emplace_back(row.case_class, row.aspect_ratio);
  std::vector<std::string> headings = {"criterion"};
  for (const auto& [name, ratio] : classes) headings.push_back(breakable(class_name(name, ratio)));
  headings.insert(headings.end(), {"largest wrong gap", "per call"});
  std::string text;
  for (const std::string& method : methods) {
    text += row_heading(method);
    double largest = 0, time = 0;
    for (const OverlapRow& row : rows) {
      if (row.method != method) continue;
      largest = std::max(largest, row.largest_wrong_gap);
      if (row.case_class == "near_contact" || time == 0) time = row.ns_per_call;
      text += failure_cell(row.wrong(), row.pairs,
                           fmt::format("{} pairs: {} disjoint ones called overlapping, {} "
                                       "overlapping ones called disjoint",
                                       row.pairs, row.wrong_overlap, row.wrong_disjoint));
    }
    text += cell(largest == 0 ? "·" : error_text(largest)) + cell(time_text(time)) + "</tr>\n";
  }
  return paragraph(
             "Share of the pairs judged wrongly, against the contact function in 80-bit "
             "arithmetic. “vieillard_baron_incomplete” is the rule Ψ &gt; 0 alone, which "
             "takes crossed and contained pairs for disjoint; polygons have the area of "
             "their ellipse.") +
         figure(chart_svg(overlap_chart(rows))) + table("matrix", headings, text);
}

std::string corrections_cell(const WholeRun& run) {
  const std::string text = count_text(run.correction_moves);
  return run.correction_moves == 0 ? cell(text) : "<td class=\"many\">" + text + "</td>";
}

std::string whole_run_section(const std::vector<WholeRun>& runs) {
  std::string rows;
  for (const WholeRun& run : runs) {
    const double moves = corrections_per_thousand(run);
    rows += row_heading(run.method) + cell(fmt::format("{:.2g}", run.tolerance)) +
            cell(fmt::format("{:.4g}{}", run.simulated_time,
                             run.stood_still ? ", then stood still" : "")) +
            cell(count_text(run.collisions)) + corrections_cell(run) +
            cell(std::isnan(moves) ? "–"
                 : moves == 0      ? "·"
                                   : ratio_text(moves)) +
            cell(fmt::format("{:.0f}", run.collisions_per_second)) +
            cell(error_text(run.energy_drift)) +
            cell(run.deepest_overlap == 0 ? "·" : error_text(run.deepest_overlap)) + "</tr>\n";
  }
  return paragraph(
             "The scene of the thesis (100 ellipses with κ = 2 at φ = 0.5, from a square lattice), "
             "with every method that can carry a run, at each of its tolerances. A collision that "
             "is overlooked becomes an overlap, for which the thesis has its correction move.") +
         figure(chart_svg(whole_run_chart(runs))) +
         table("",
               {"method", "tolerance", "time", "collisions", "correction moves",
                "per 1000 collisions", "collisions per second", "energy drift", "deepest overlap"},
               rows) +
         "<p class=\"note\">The roots of Ψ and of Perram and Wertheim’s function do not know which "
         "side they touch from: of a pair that has just collided, contact within rounding now and "
         "then counts as an overlap, at any tolerance. SLSQP reports contacts that are none, too: "
         "its collisions are not those of the scene, and at a coarse tolerance they go on without "
         "end at one time. The energy says nothing about that: wrong collisions and correction "
         "moves conserve it as well. Overlaps are in semi-minor axes, at the samples.</p>\n";
}

std::string scene_section() {
  const std::vector<SceneAnswer> answers = scene_answers();
  const double truth = answers.front().time.value();
  std::string rows;
  for (const SceneAnswer& answer : answers)
    rows += row_heading(answer.method) +
            cell(answer.time ? fmt::format("{:.15f}", *answer.time) : "no contact") +
            cell(answer.time ? error_text(*answer.time - truth) : "–") + "</tr>\n";
  return paragraph(
             "Two ellipses with a = 1, b = 0.5: one rests at the origin, the other comes from "
             "(1, 1) with velocity (−1, 0) and turns at π. They touch, overlap, and touch once "
             "more from inside the overlap at t = 1: a trap for methods that look for any root.") +
         figure(chart_svg(scene_gap_chart())) + figure(chart_svg(scene_psi_chart())) +
         table("", {"method", "time of the first contact", "off by"}, rows);
}

std::string provenance_section(const PageProvenance& provenance) {
  return section("provenance", "How it was measured",
                 "<dl>\n" + provenance_entries(provenance) + "</dl>\n");
}

std::string page(const std::string& title, const std::string& subtitle,
                 const std::string& content) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'\">\n<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>{0}</title>\n<style>\n{1}{2}</style>\n</head>\n<body>\n"
      "<a class=\"skip\" href=\"#main\">Skip to the results</a>\n"
      "<header>\n<h1>{0}</h1>\n<p class=\"subtitle\">{3}</p>\n</header>\n<main id=\"main\">\n"
      "{4}</main>\n</body>\n</html>\n",
      escaped(title), asset("page/report.css"), style, escaped(subtitle), content);
}

}  // namespace

std::string collision_time_page(const CollisionTimeBench& bench,
                                const std::vector<OverlapRow>& overlap,
                                const std::vector<WholeRun>& runs,
                                const PageProvenance& provenance) {
  const std::vector<SurveyRow>& rows = bench.survey.rows;
  std::string content = section(
      "glance", "Methods at a glance",
      paragraph("Time per prediction on random pairs, and what went wrong on all classes that the "
                "method answers at all.") +
          glance(rows));
  content += section(
      "speed", "Speed against accuracy",
      paragraph("Further left is faster, further down is more accurate. Errors are taken from the "
                "pairs for which contact exists and is found: what a method misses is in its "
                "hollow markers and in the table below.") +
          figure(chart_svg(speed_chart(bench.tolerances, ChartedError::median))) +
          figure(chart_svg(speed_chart(bench.tolerances, ChartedError::largest))));
  content += section("stability", "Where methods fail", stability(rows));
  if (!bench.survey.failures.empty())
    content += section("failures", "One failing pair each", failures(bench.survey.failures));
  content += section("scene", "The scene of the thesis", scene_section());
  content += section("runs", "Whole runs", whole_run_section(runs));
  content += section("overlap", "Overlap tests", overlap_section(overlap));
  return page("Collision time: speed, accuracy, stability",
              "Every method, asked about the same pairs, judged by a guaranteed reference in "
              "80-bit arithmetic",
              content + provenance_section(provenance));
}

std::string overlap_page(const std::vector<OverlapRow>& rows, const PageProvenance& provenance) {
  return page(
      "Overlap tests: speed and accuracy",
      "Every criterion, asked about the same pairs of ellipses",
      section("overlap", "Overlap tests", overlap_section(rows)) + provenance_section(provenance));
}

std::string whole_run_page(const std::vector<WholeRun>& runs, const PageProvenance& provenance) {
  return page(
      "Whole runs: speed and correction moves",
      "The scene of the thesis, with different methods to predict its collisions",
      section("runs", "Whole runs", whole_run_section(runs)) + provenance_section(provenance));
}

}  // namespace vitrel
