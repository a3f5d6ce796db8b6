#include "app/commands/common.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "app/workflow/stop.h"
#include "core/error.h"

namespace vitrel {

Session::Session(const Arguments& arguments)
    : display_(ProgressDisplay::mode(arguments.quiet)), wall_time_(arguments.wall_time) {
  catch_stop_signals();
  budget_.should_stop = [this] {
    return stop_signalled() || (wall_time_ > 0 && seconds() > wall_time_);
  };
  budget_.report = [this](const Progress& progress) { display_.show(progress); };
  say_ = [this](const std::string& line) {
    display_.say(line);
    display_.begin(line.substr(0, line.find(' ')));
  };
}

double Session::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

ParameterSource parameter_source(const Arguments& arguments) {
  return {arguments.input, arguments.overrides, arguments.seed};
}

AnalysisChoice analysis_choice(const Arguments& arguments) {
  AnalysisChoice choice;
  if (!arguments.parameters.empty()) choice.parameters = arguments.parameters;
  choice.overrides = arguments.overrides;
  choice.progress = ProgressDisplay::mode(arguments.quiet);
  return choice;
}

void require_new(const std::filesystem::path& output) {
  if (std::filesystem::exists(output))
    throw UserError(output.string() + ": exists already; choose another output, or delete it");
}

void print_summary(const Arguments& arguments, const nlohmann::ordered_json& summary) {
  if (arguments.json) {
    fmt::print("{}\n", summary.dump(2));
  } else if (!arguments.quiet) {
    for (const auto& [key, value] : summary.items()) {
      const bool is_real = value.is_number_float();
      fmt::print("{:<26} {}\n", key,
                 is_real             ? fmt::format("{:.8g}", value.get<double>())
                 : value.is_string() ? value.get<std::string>()
                                     : value.dump());
    }
  }
  flush_output();
}

void flush_output() {
  if (std::fflush(stdout) != 0)
    throw FileError(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
}

void remark(const Arguments& arguments, const std::string& line) {
  if (!arguments.quiet) fmt::print(stderr, "{}\n", line);
}

}  // namespace vitrel
