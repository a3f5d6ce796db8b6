#include "app/workflow/analyze.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/workflow/sweep_results.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

int analyze_file(const Arguments& arguments) {
  fs::path output = arguments.output;
  if (output.empty())
    output = arguments.input.parent_path() / (arguments.input.stem().string() + "_results.h5");
  const AnalysedRun analysis = analyze_run(arguments.input, analysis_choice(arguments));
  write_all(output, analysis.results);
  Json summary = analysis_summary(analysis);
  summary["output"] = output.string();
  print_summary(arguments, summary);
  return success;
}

int analyze_sweep(const Arguments& arguments) {
  const fs::path output =
      arguments.output.empty() ? arguments.input / "results.h5" : arguments.output;
  const AnalysisChoice choice = analysis_choice(arguments);
  const std::vector<AnalysedRun> analyses = analysed_jobs(arguments.input, choice);
  Json runs = Json::array();
  for (const AnalysedRun& run : analyses) {
    if (choice.given()) write_all(run.file.parent_path() / "results.h5", run.results);
    runs.push_back(analysis_summary(run));
  }
  const GlassStudy study = glass_study(analyses);
  write_all(output, results_of_sweep(analyses, study));
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
