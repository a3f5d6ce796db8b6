#include "app/workflow/analyze.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/workflow/sweep.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

AnalysisChoice analysis_choice(const Arguments& arguments) {
  AnalysisChoice choice;
  if (!arguments.parameters.empty()) choice.parameters = arguments.parameters;
  choice.overrides = arguments.overrides;
  choice.progress = ProgressDisplay::mode(arguments.quiet);
  return choice;
}

int analyze_file(const Arguments& arguments) {
  fs::path output = arguments.output;
  if (output.empty())
    output = arguments.input.parent_path() / (arguments.input.stem().string() + "_results.h5");
  const RunAnalysis analysis = analyze_run(arguments.input, analysis_choice(arguments));
  write_all(output, results_of(analysis));
  Json summary = analysis_summary(analysis);
  summary["output"] = output.string();
  print_summary(arguments, summary);
  return success;
}

int analyze_sweep(const Arguments& arguments) {
  const fs::path output =
      arguments.output.empty() ? arguments.input / "results.h5" : arguments.output;
  std::vector<RunAnalysis> analyses;
  Json runs = Json::array();
  for (const fs::path& folder : finished_jobs(arguments.input)) {
    analyses.push_back(analyze_run(folder / "run.h5", analysis_choice(arguments)));
    write_all(folder / "results.h5", results_of(analyses.back()));
    runs.push_back(analysis_summary(analyses.back()));
  }
  write_all(output, results_of_sweep(analyses));
  const GlassStudy study = glass_study(analyses);
  Json summary = {{"output", output.string()}};
  if (arguments.json)
    summary.update({{"runs", std::move(runs)}, {"glass", glass_summary(study)}});
  else if (!arguments.quiet)
    std::fputs(glass_text(study).c_str(), stdout);
  print_summary(arguments, summary);
  return success;
}

}  // namespace

int analyze_command(const Arguments& arguments) {
  return fs::is_directory(arguments.input) ? analyze_sweep(arguments) : analyze_file(arguments);
}

}  // namespace vitrel
