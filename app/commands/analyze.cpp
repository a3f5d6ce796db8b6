#include "workflow/analyze/analyze.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "workflow/sweep/sweep_results.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Where results go must be free, or hold those of an earlier analysis.
void require_place(const fs::path& output, const std::vector<fs::path>& inputs) {
  require_output_file(output, inputs);
  former_tables(output);
}

int analyze_file(const Arguments& arguments, const fs::path& run) {
  fs::path output = arguments.output;
  if (output.empty()) output = run.parent_path() / (run.stem().string() + "_results.h5");
  const AnalysisChoice choice = analysis_choice(arguments);
  require_place(output, {run, arguments.parameters});
  const AnalysedRun analysis = analyze_run(run, choice);
  write_all(output, analysis.results);
  Json summary = analysis_summary(analysis);
  summary["output"] = output.string();
  print_summary(arguments, summary);
  return success;
}

int analyze_sweep(const Arguments& arguments, const fs::path& folder) {
  const fs::path output = arguments.output.empty() ? folder / "results.h5" : arguments.output;
  const AnalysisChoice choice = analysis_choice(arguments);
  const SweepProgress sweep = sweep_progress(folder);
  require_place(output, sweep.files());
  remark_left_out(arguments, sweep);
  const std::vector<AnalysedRun> analyses = analysed_jobs(sweep, choice);
  Json runs = Json::array();
  for (const AnalysedRun& run : analyses) runs.push_back(analysis_summary(run));
  const GlassStudy study = glass_study(analyses);
  Results results = results_of_sweep(analyses, study);
  if (!sweep.unfinished.empty()) results.provenance.emplace_back("left_out", sweep.left_out());
  write_all(output, results);
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
  const fs::path input = run_or_sweep(arguments.input);
  return fs::is_directory(input) ? analyze_sweep(arguments, input) : analyze_file(arguments, input);
}

}  // namespace vitrel
