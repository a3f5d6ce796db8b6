#include "app/commands/common.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "app/terminal/progress.h"
#include "app/terminal/session.h"
#include "app/terminal/style.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/io/number_text.h"
#include "workflow/analyze/analyze.h"
#include "workflow/configuration/parameters.h"
#include "workflow/sweep/job_folder.h"
#include "workflow/sweep/sweep.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

/// `sections` are the sections whose keys have an effect.
void require_key_of(std::span<const std::string_view> sections, const std::string& assignment) {
  const auto is_below = [&](std::string_view section) {
    return assignment.starts_with(fmt::format("{}.", section)) ||
           assignment.starts_with(fmt::format("{}=", section));
  };
  if (assignment.find('=') != std::string::npos && !std::ranges::any_of(sections, is_below))
    throw UserError(
        fmt::format("--set {}: has no effect on an existing run; only {}.… can be set here, and "
                    "`vitrel params analyze` prints them",
                    assignment, fmt::join(sections, ".… and ")));
}

void require_folder_of(const fs::path& output) {
  const fs::path folder = fs::absolute(output).parent_path();
  if (!fs::is_directory(folder))
    throw FileError(fmt::format("{}: cannot be written: there is no folder {}", output.string(),
                                folder.string()));
}

std::string stopped_summary(const fs::path& output) {
  return json_text({{"output", output.string()}, {"complete", false}}, 2) + '\n';
}

constexpr std::string_view error_suffix = "_error";

/// Whether the value is the error of another value and is printed with it.
bool is_error(const Json& summary, const std::string& key) {
  return key.ends_with(error_suffix) &&
         summary.contains(key.substr(0, key.size() - error_suffix.size()));
}

/// Marks overlaps on a terminal.
std::string emphasized(const std::string& key, const Json& value, const std::string& text) {
  return key == "overlaps" && value > 0 ? styled(text, Style::error, STDOUT_FILENO) : text;
}

std::string text_of(const Json& value) {
  if (value.is_string()) return visible(value.get<std::string>());
  if (value.is_array()) {
    std::string joined;
    for (const Json& entry : value) joined += (joined.empty() ? "" : ", ") + text_of(entry);
    return joined;
  }
  if (!value.is_number_float()) return json_text(value);
  const auto number = value.get<double>();
  return std::isnan(number) ? "–" : fmt::format("{:.8g}", number);
}

std::string value_text(const Json& summary, const std::string& key) {
  const Json& value = summary.at(key);
  const auto error = summary.find(key + std::string(error_suffix));
  const bool has_error = value.is_number_float() && error != summary.end();
  return has_error ? with_error(value.get<double>(), error->get<double>()) : text_of(value);
}

/// Adds the keys that earlier versions used, at every depth, beside those that replaced them.
Json with_former_keys(Json json) {
  for (Json& part : json)
    if (part.is_structured()) part = with_former_keys(std::move(part));
  for (const char* suffix : {"", "_error"}) {
    const std::string key = std::string("compressibility_factor") + suffix;
    if (!json.is_object() || !json.contains(key)) continue;
    Json value = json.at(key);
    json[std::string("compressibility") + suffix] = std::move(value);
  }
  return json;
}

}  // namespace

ParameterSource parameter_source(const ParameterOptions& options, const StartOptions& start) {
  ParameterSource source{options.file, options.overrides, options.seed};
  if (!start.from.empty()) source.start = StartFile{start.from, start.shrink};
  return source;
}

AnalysisChoice analysis_choice(const AnalysisOptions& options) {
  static constexpr std::array<std::string_view, 2> sections = {"analysis", "import"};
  for (const std::string& assignment : options.overrides) require_key_of(sections, assignment);
  AnalysisChoice choice;
  if (!options.file.empty()) choice.parameters = options.file;
  choice.overrides = options.overrides;
  return choice;
}

KnownSystem import_choice(const AnalysisOptions& options) {
  static constexpr std::array<std::string_view, 1> sections = {"import"};
  for (const std::string& assignment : options.overrides) require_key_of(sections, assignment);
  return known_system(analysis_choice(options));
}

AnalysisProgress shown_on(ProgressDisplay& display) {
  return {[&display](const std::string& phase) { display.begin(phase); },
          [&display](const Progress& progress) { display.show(progress); }};
}

fs::path run_or_sweep(const fs::path& input) {
  if (!fs::exists(input)) throw FileError(input.string() + ": there is no such file or folder");
  const bool is_job = fs::exists(input / "parameters.toml") &&
                      (fs::exists(input / "run.h5") || job_stage(input) == JobStage::done);
  return is_job ? job_product(input) : input;
}

void require_output_file(const fs::path& output, const std::vector<fs::path>& inputs) {
  require_folder_of(output);
  if (fs::exists(output) && !fs::is_regular_file(output))
    throw UserError(fmt::format("{}: is a {}, but a file is to be written; choose another output",
                                output.string(), fs::is_directory(output) ? "folder" : "device"));
  for (const fs::path& input : inputs)
    if (std::error_code ignored; fs::equivalent(output, input, ignored))
      throw UserError(output.string() +
                      ": is read, and must not be overwritten; choose another output");
}

void require_new(const fs::path& output) {
  require_folder_of(output);
  if (fs::exists(output))
    throw UserError(output.string() + ": exists already; choose another output, or delete it");
}

void print_summary(const PrintOptions& options, const Json& summary) {
  if (options.json) {
    print_text(json_text(with_former_keys(summary), 2) + '\n');
  } else if (!options.quiet) {
    for (const auto& [key, value] : summary.items()) {
      if (value.is_object()) continue;  // objects are for programs only
      const std::string text = value_text(summary, key);
      if (!is_error(summary, key) && !text.empty())
        print_text(fmt::format("{:<26} {}\n", key, emphasized(key, value, text)));
    }
  }
}

void print_stopped(const PrintOptions& options, const fs::path& output) {
  if (options.json) print_text(stopped_summary(output));
}

void print_stopped_if_ended(const PrintOptions& options, const fs::path& output) {
  if (options.json) set_summary_of_stop(stopped_summary(output));
}

void remark(const PrintOptions& options, const std::string& line) {
  if (!options.quiet) fmt::print(stderr, "{}\n", visible(line));
}

void remark_import(const PrintOptions& options, const fs::path& file, const ImportReport& report) {
  if (report.empty()) return;
  if (report.front().first == in_progress)
    return remark(options, file.string() + ": " + report.front().second);
  remark(options, file.string() + ": read as a file of another program");
  for (const auto& [heading, text] : report)
    remark(options, fmt::format("  {:<14} {}", heading, text));
}

void remark_left_out(const PrintOptions& options, const fs::path& folder,
                     const SweepProgress& sweep) {
  if (!sweep.unfinished.empty()) remark(options, folder.string() + ": " + sweep.left_out());
}

}  // namespace vitrel
