#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/workflow/bench/bench_page.h"
#include "app/workflow/bench/overlap.h"
#include "app/workflow/bench/passing_pair.h"
#include "app/workflow/bench/picture.h"
#include "app/workflow/bench/scene.h"
#include "app/workflow/bench/thesis.h"
#include "app/workflow/bench/whole_run.h"
#include "bench/lab/recorded_class.h"
#include "bench/lab/solids/suite.h"
#include "core/io/provenance.h"
#include "workflow/storage/text_file.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Fields in the order of the page and of the JSON file; `what` are those of the benchmark itself.
PageProvenance provenance(const Arguments& arguments, const PageProvenance& what,
                          const Session& session) {
  const Provenance now = current_provenance(arguments.command_line, "", 0);
  PageProvenance fields = {{"command", now.command_line}};
  fields.insert(fields.end(), what.begin(), what.end());
  fields.insert(fields.end(), {{"version", now.version},
                               {"commit", now.commit},
                               {"host", now.host},
                               {"finished", now.started},
                               {"wall time", fmt::format("{:.0f} s", session.seconds())}});
  return fields;
}

std::string pairs_text(std::uint64_t pairs, std::uint64_t seed) {
  return fmt::format("{} of each class, seed {}", pairs, seed);
}

Json as_json(const PageProvenance& provenance) {
  Json result = Json::object();
  for (const auto& [name, text] : provenance) result[name] = text;
  return result;
}

void print_rows(const Arguments& arguments, Session& session, const Json& rows,
                const std::string& table) {
  session.clear();
  if (arguments.json)
    fmt::print("{}\n", Json{{"rows", rows}}.dump(2));
  else if (!arguments.quiet)
    fmt::print("{}", table);
  flush_output();
}

int stopped_early(const Arguments& arguments) {
  remark(arguments, "stopped; the table has the pairs done so far, and no files were written");
  return stopped;
}

CollisionTimeRequest collision_time_request(const Arguments& arguments) {
  CollisionTimeRequest request;
  request.pairs = arguments.pairs.value_or(request.pairs);
  request.seconds = arguments.seconds.value_or(request.seconds);
  request.seed = arguments.seed.value_or(request.seed);
  if (arguments.tolerance) request.tolerance = {*arguments.tolerance, *arguments.tolerance};
  if (arguments.gap_tolerance) request.tolerance.gap = *arguments.gap_tolerance;
  request.methods = arguments.methods;
  request.classes = arguments.classes;
  request.with_chart = !arguments.output.empty();
  return request;
}

PageProvenance collision_time_provenance(const CollisionTimeRequest& request) {
  return {
      {"pairs", pairs_text(request.pairs, request.seed)},
      {"time limit", fmt::format("{:g} s for a method that is not the default", request.seconds)}};
}

template <class CaseClass>
Json classes_json(const std::vector<CaseClass>& classes) {
  Json list = Json::array();
  for (const CaseClass& of : classes)
    list.push_back(
        {{"class", of.name}, {"aspect_ratio", of.aspect_ratio}, {"meaning", of.meaning}});
  return list;
}

std::string failure_file(const lab::FailingCase& failure) {
  return "failure_" + failure.method + ".svg";
}

Json failures_json(const std::vector<lab::FailingCase>& failures) {
  Json list = Json::array();
  for (const lab::FailingCase& failure : failures)
    list.push_back({{"method", failure.method},
                    {"class", failure.case_class.name},
                    {"aspect_ratio", failure.case_class.aspect_ratio},
                    {"index", failure.index},
                    {"caption", failure_caption(failure)},
                    {"picture", failure_file(failure)}});
  return list;
}

void write_collision_time(const fs::path& folder, const CollisionTimeBench& bench,
                          const std::vector<lab::OverlapRow>& overlap,
                          const std::vector<lab::WholeRun>& runs,
                          const PageProvenance& provenance) {
  make_folder(folder);
  const Json data = {{"rows", collision_time_json(bench.survey.rows)},
                     {"classes", classes_json(lab::all_classes())},
                     {"tolerances", collision_time_json(bench.tolerances)},
                     {"tolerances_judged_by", charted_tolerance},
                     {"scene", scene_json(scene_answers())},
                     {"failures", failures_json(bench.survey.failures)},
                     {"overlap", overlap_json(overlap)},
                     {"whole_runs", whole_run_json(runs)},
                     {"provenance", as_json(provenance)}};
  write_text(folder / "collision-time.json", data.dump(2) + "\n");
  write_text(folder / "collision-time.svg",
             chart_svg(speed_chart(bench.tolerances, ChartedError::median)));
  write_text(folder / "collision-time-largest.svg",
             chart_svg(speed_chart(bench.tolerances, ChartedError::largest)));
  write_text(folder / "scene_gap.svg", chart_svg(scene_gap_chart()));
  write_text(folder / "scene_psi.svg", chart_svg(scene_psi_chart()));
  for (const lab::FailingCase& failure : bench.survey.failures)
    write_text(folder / failure_file(failure), failure_svg(failure));
  write_text(folder / "overlap.svg", chart_svg(overlap_chart(overlap)));
  write_text(folder / "whole-run.svg", chart_svg(whole_run_chart(runs)));
  write_text(folder / "collision-time.html", collision_time_page(bench, overlap, runs, provenance));
}

/// The data, the chart and the page of one benchmark.
void write_files(const fs::path& folder, const std::string& name, const Json& rows,
                 const PageProvenance& provenance, const std::string& chart,
                 const std::string& page) {
  make_folder(folder);
  const Json data = {{"rows", rows}, {"provenance", as_json(provenance)}};
  write_text(folder / (name + ".json"), data.dump(2) + "\n");
  write_text(folder / (name + ".svg"), chart);
  write_text(folder / (name + ".html"), page);
}

}  // namespace

int bench_collision_time_command(const Arguments& arguments) {
  const CollisionTimeRequest request = collision_time_request(arguments);
  if (!arguments.output.empty()) require_output_folder(arguments.output);
  Session session(arguments);
  const CollisionTimeBench bench = bench_collision_time(request, session.control(), session.say());
  print_rows(arguments, session, collision_time_json(bench.survey.rows),
             collision_time_text(bench.survey.rows));
  if (bench.stopped) return stopped_early(arguments);
  if (arguments.output.empty()) return success;
  session.say()("overlap criteria");
  OverlapRequest criteria;
  criteria.seed = request.seed;
  const lab::OverlapSurvey overlap = bench_overlap(criteria, session.control());
  if (overlap.stopped) return stopped_early(arguments);
  session.say()("whole runs");
  WholeRunRequest scene;
  scene.duration = arguments.duration.value_or(20);
  scene.seed = request.seed;
  const WholeRunBench runs = bench_whole_run(scene, session.control());
  if (runs.stopped) return stopped_early(arguments);
  PageProvenance what = collision_time_provenance(request);
  what.push_back({"whole runs", fmt::format("{:g} units of time", scene.duration)});
  write_collision_time(arguments.output, bench, overlap.rows, runs.rows,
                       provenance(arguments, what, session));
  return success;
}

int bench_collision_time_of_solids_command(const Arguments& arguments) {
  const CollisionTimeRequest request = collision_time_request(arguments);
  if (!arguments.output.empty()) require_output_folder(arguments.output);
  Session session(arguments);
  const auto bench = bench_collision_time_of_solids(request, session.control(), session.say());
  print_rows(arguments, session, collision_time_json(bench.survey.rows),
             collision_time_text(bench.survey.rows));
  if (bench.stopped) return stopped_early(arguments);
  if (arguments.output.empty()) return success;
  const Json data = {
      {"rows", collision_time_json(bench.survey.rows)},
      {"classes", classes_json(lab::solid_suite())},
      {"tolerances", collision_time_json(bench.tolerances)},
      {"tolerances_judged_by", charted_tolerance},
      {"passing_pair", passing_pair_json()},
      {"provenance", as_json(provenance(arguments, collision_time_provenance(request), session))}};
  make_folder(arguments.output);
  write_text(arguments.output / "collision-time.json", data.dump(2) + "\n");
  for (const auto& [file, chart] :
       {std::pair("median.svg", speed_chart(bench.tolerances, ChartedError::median)),
        std::pair("largest.svg", speed_chart(bench.tolerances, ChartedError::largest)),
        std::pair("passing_pair.svg", passing_pair_chart())})
    write_text(arguments.output / file, chart_svg(chart));
  return success;
}

int bench_overlap_command(const Arguments& arguments) {
  OverlapRequest request;
  request.pairs = arguments.pairs.value_or(request.pairs);
  request.seconds = arguments.seconds.value_or(request.seconds);
  request.seed = arguments.seed.value_or(request.seed);
  request.methods = arguments.methods;
  request.classes = arguments.classes;
  if (!arguments.output.empty()) require_output_folder(arguments.output);
  Session session(arguments);
  session.say()("overlap criteria");
  const lab::OverlapSurvey survey = bench_overlap(request, session.control());
  print_rows(arguments, session, overlap_json(survey.rows), overlap_text(survey.rows));
  if (survey.stopped) return stopped_early(arguments);
  if (arguments.output.empty()) return success;
  const PageProvenance how =
      provenance(arguments,
                 {{"pairs", pairs_text(request.pairs, request.seed)},
                  {"time limit", fmt::format("{:g} s for a criterion", request.seconds)}},
                 session);
  write_files(arguments.output, "overlap", overlap_json(survey.rows), how,
              chart_svg(overlap_chart(survey.rows)), overlap_page(survey.rows, how));
  return success;
}

int bench_thesis_command(const Arguments& arguments) {
  ThesisRequest request;
  request.seconds = arguments.seconds.value_or(request.seconds);
  request.duration = arguments.duration.value_or(request.duration);
  request.relaxations = arguments.runs.value_or(request.relaxations);
  request.largest = arguments.largest.value_or(request.largest);
  request.seed = arguments.seed.value_or(request.seed);
  if (!arguments.output.empty()) require_output_folder(arguments.output);
  Session session(arguments);
  const ThesisBench bench = bench_thesis(request, session.control(), session.say());
  print_rows(arguments, session, thesis_rows_json(bench.by_size), thesis_text(bench));
  if (bench.stopped) return stopped_early(arguments);
  if (arguments.output.empty()) return success;
  Json data = thesis_json(bench);
  data["provenance"] = as_json(provenance(
      arguments,
      {{"runs", fmt::format("{:g} units of time, up to {} particles, seed {}", request.duration,
                            request.largest, request.seed)},
       {"time limit", fmt::format("{:g} s for a run of the thesis's program", request.seconds)}},
      session));
  make_folder(arguments.output);
  write_text(arguments.output / "thesis.json", data.dump(2) + "\n");
  for (const ThesisFigure& figure : thesis_figures(bench))
    write_text(arguments.output / figure.file, chart_svg(figure.chart));
  return success;
}

int bench_whole_run_command(const Arguments& arguments) {
  WholeRunRequest request;
  request.duration = arguments.duration.value_or(request.duration);
  request.seed = arguments.seed.value_or(request.seed);
  request.methods = arguments.methods;
  if (!arguments.output.empty()) require_output_folder(arguments.output);
  Session session(arguments);
  session.say()("whole runs");
  const WholeRunBench bench = bench_whole_run(request, session.control());
  print_rows(arguments, session, whole_run_json(bench.rows), whole_run_text(bench.rows));
  if (bench.stopped) return stopped_early(arguments);
  if (arguments.output.empty()) return success;
  const PageProvenance how = provenance(
      arguments,
      {{"scene", fmt::format("{:g} units of time, seed {}", request.duration, request.seed)}},
      session);
  write_files(arguments.output, "whole-run", whole_run_json(bench.rows), how,
              chart_svg(whole_run_chart(bench.rows)), whole_run_page(bench.rows, how));
  return success;
}

}  // namespace vitrel
