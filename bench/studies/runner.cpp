#include "bench/studies/runner.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "app/terminal/exit_codes.h"
#include "app/terminal/session.h"
#include "bench/pages/assets.h"
#include "bench/studies/choice.h"
#include "bench/studies/tables.h"
#include "core/error.h"
#include "core/io/provenance.h"
#include "core/io/text_file.h"
#include "workflow/report/assets.h"
#include "workflow/report/page_parts.h"

namespace vitrel::bench {
namespace {

/// Throws FileError if the folder does not exist and cannot be created because part of its path is a file.
void require_output_folder(const std::filesystem::path& output) {
  std::filesystem::path there = std::filesystem::absolute(output);
  while (!std::filesystem::exists(there)) there = there.parent_path();
  if (!std::filesystem::is_directory(there))
    throw FileError(fmt::format("{}: the folder cannot be made: {} is a file", output.string(),
                                there.string()));
}

/// The name that the system gives the processor; empty if it gives none.
std::string processor() {
  const std::string key = "model name";
  const std::string all =
      std::filesystem::exists("/proc/cpuinfo") ? read_text("/proc/cpuinfo") : "";
  const std::size_t at = all.find(key);
  if (at == std::string::npos) return "";
  const std::size_t begin = all.find(": ", at) + 2;
  return all.substr(begin, all.find('\n', begin) - begin);
}

Json provenance_of(const OutputOptions& output, const StudyOptions& options, double seconds) {
  const Provenance now = current_provenance(output.command_line, "", options.seed);
  Json json = {{"command", now.command_line},
               {"commit", now.commit},
               {"version", now.version},
               {"processor", processor()},
               {"host", now.host},
               {"compiler", "g++ " __VERSION__},
               {"flags", VITREL_FLAGS},
               {"date", now.started},
               {"wall time", fmt::format("{:.0f} s", seconds)}};
  json["seed"] = std::to_string(options.seed);
  return json;
}

PageProvenance entries(const Json& provenance) {
  PageProvenance list;
  for (const auto& [name, text] : provenance.items()) list.emplace_back(name, text);
  return list;
}

const Part& part_named(const Study& study, const std::string& name) {
  return *std::ranges::find(study.parts, name, &Part::name);
}

/// The sentences and tables of all parts, with or without the charts that scripts/validate saves in the folder of the
/// study. A part shows all its numbers if they are few. Otherwise it shows how costs compare, unless charts show
/// that.
std::string parts_text(const Study& study, const Json& numbers, bool has_charts) {
  constexpr std::size_t few_rows = 24;
  std::string text;
  for (const Json& of : numbers["parts"]) {
    const Part& part = part_named(study, of["name"]);
    text += fmt::format("\n## {}\n\n{}\n", part.name, part.about);
    if (const std::string answer = of["answer"]; !answer.empty())
      text += fmt::format("\n**{}**\n", answer);
    const Json charts = has_charts ? charts_of(part, of["rows"]) : Json::array();
    int number = 0;
    for (const Json& chart : charts)
      text += fmt::format("\n![{}]({}/{}-{}.svg)\n", chart["heading"].get<std::string>(),
                          study.name, part.name, ++number);
    const std::vector<StudyTable> tables = tables_of(part, of["rows"]);
    const bool few = tables.back().rows.size() <= few_rows;
    const std::array shown = {true, !few && charts.empty(), few};
    for (const StudyTable& table : tables)
      if (shown.at(static_cast<std::size_t>(table.content)))
        text += fmt::format("\n{}:\n\n{}", table.heading, markdown(table));
  }
  return text;
}

void write(const std::filesystem::path& file, const Study& study, const Json& numbers) {
  const std::string kind = file.extension();
  if (kind == ".html")
    write_text(file, study_page(study, numbers));
  else if (kind == ".md")
    write_text(file, study_markdown(study, numbers));
  else
    write_text(file, json_text(numbers, 2) + "\n");
}

bool is_folder(const std::filesystem::path& file) {
  const std::string kind = file.extension();
  return kind != ".html" && kind != ".md" && kind != ".json";
}

void write_all(const std::filesystem::path& file, const Study& study, const Json& numbers) {
  if (!is_folder(file)) return write(file, study, numbers);
  make_folder(file);
  for (const char* const kind : {".html", ".md", ".json"})
    write(file / (study.name + kind), study, numbers);
}

/// Throws UserError for a name that occurs in no part.
void require_known(const std::vector<Part>& parts, std::vector<std::string> Part::*names,
                   const std::vector<std::string>& wanted, const std::string& kind) {
  std::vector<Named> all;
  for (const Part& part : parts)
    for (const std::string& name : part.*names) all.push_back({name});
  chosen(all, wanted, kind);
}

}  // namespace

std::string study_markdown(const Study& study, const Json& numbers) {
  const Json& from = numbers["provenance"];
  const auto text = [&](const char* key) { return from.at(key).get<std::string>(); };
  std::string page =
      fmt::format("# {}\n\nMeasured on {}, commit {}, {}, {}, in {}, with\n\n    {}\n",
                  study.question, text("date").substr(0, 10), text("commit").substr(0, 8),
                  text("processor"), text("compiler"), text("wall time"), text("command"));
  page += parts_text(study, numbers, true);
  if (!study.settled.empty()) page += "\n## Answered before\n";
  for (const std::string& answer : study.settled) page += "\n- " + answer + "\n";
  return page;
}

std::string study_page(const Study& study, const Json& numbers) {
  Json data = {{"parts", Json::array()}, {"settled", study.settled}};
  for (const Json& of : numbers["parts"]) {
    const Part& part = part_named(study, of["name"]);
    Json shown = {{"name", part.name}, {"about", part.about}, {"answer", of["answer"]}};
    shown["charts"] = charts_of(part, of["rows"]);
    for (const StudyTable& table : tables_of(part, of["rows"]))
      shown["tables"].push_back(table_json(table));
    data["parts"].push_back(shown);
  }
  if (numbers.contains("more")) data["more"] = numbers["more"];
  const auto shared = [](std::string_view path) { return std::string(vitrel::asset(path)); };
  return filled(asset("pages/page.html"),
                {{"title", escaped(study.question)},
                 {"uplot_style", shared("vendor/uplot/uPlot.min.css")},
                 {"style", shared("page/report.css")},
                 {"bench_style", std::string(asset("pages/bench.css"))},
                 {"provenance", provenance_entries(entries(numbers["provenance"]))},
                 {"data", script_safe(data)},
                 {"uplot_licence", shared("vendor/uplot/LICENSE")},
                 {"uplot", shared("vendor/uplot/uPlot.iife.min.js")},
                 {"common", shared("page/common.js")},
                 {"vector", shared("page/vector.js")},
                 {"axes", shared("page/axes.js")},
                 {"charts", shared("page/charts.js")},
                 {"tables", shared("page/tables.js")},
                 {"script", std::string(asset("pages/bench.js"))}});
}

int run_study(const Study& study, const StudyOptions& options, const OutputOptions& output) {
  const std::vector<Part> parts = chosen(study.parts, options.parts, "part");
  require_known(parts, &Part::method_names, options.methods, "method");
  require_known(parts, &Part::class_names, options.classes, "class");
  if (!output.file.empty())
    require_output_folder(is_folder(output.file)
                              ? output.file
                              : std::filesystem::absolute(output.file).parent_path());
  Session session(output.quiet, output.wall_time, StopDeadline::none);
  Json more = Json::object();
  const StudyContext context{options, session.control(), more};
  Json numbers = {{"study", study.name}, {"question", study.question}, {"parts", Json::array()}};
  for (const Part& part : parts) {
    if (session.control().stop_requested()) break;
    session.say()(study.name + ": " + part.name);
    const Json rows = part.measure(context);
    if (rows.empty()) continue;
    numbers["parts"].push_back({{"name", part.name},
                                {"about", part.about},
                                {"answer", answer_of(part, rows)},
                                {"rows", rows}});
  }
  const bool is_stopped = session.control().stop_requested();
  if (!more.empty()) numbers["more"] = more;
  numbers["provenance"] = provenance_of(output, options, session.seconds());
  session.clear();
  if (output.json)
    print_text(json_text(numbers, 2) + '\n');
  else if (!output.quiet)
    print_text(parts_text(study, numbers, false));
  if (is_stopped) {
    if (!output.quiet)
      fmt::print(stderr,
                 "stopped; the tables have what was done so far, and no files were written\n");
    return stopped;
  }
  if (!output.file.empty()) write_all(output.file, study, numbers);
  return success;
}

}  // namespace vitrel::bench
