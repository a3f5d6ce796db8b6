#include "app/commands/commands.h"

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/progress.h"
#include "app/terminal/session.h"
#include "app/terminal/stop_signals.h"
#include "core/error.h"
#include "core/io/json.h"
#include "workflow/analyze/analyze.h"
#include "workflow/analyze/glass_report.h"
#include "workflow/analyze/observables_page.h"
#include "workflow/sweep/sweep.h"
#include "workflow/sweep/sweep_results.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

/// The output must not exist, or must hold the results of an earlier analysis.
void require_place(const fs::path& output, const std::vector<fs::path>& inputs) {
  require_output_file(output, inputs);
  former_tables(output);
}

int analyze_file(const AnalyzeOptions& options, const fs::path& run) {
  fs::path output = options.output;
  if (output.empty()) output = results_path(run);
  const AnalysisChoice choice = analysis_choice(options.analysis);
  require_place(output, {run, options.analysis.file});
  ProgressDisplay display(ProgressDisplay::mode(options.print.quiet));
  const AnalysedRun analysis = analyze_run(run, choice, shown_on(display));
  display.clear();
  write_all(output, analysis.results);
  remark_import(options.print, run, import_report(analysis.results));
  if (const std::string why = analysis.results.text("left_out_motion"); !why.empty())
    remark(options.print, run.string() + ": motion is left out: " + why);
  Json summary = analysis_summary(analysis);
  summary["output"] = output.string();
  print_summary(options.print, summary);
  return success;
}

int analyze_sweep(const AnalyzeOptions& options, const fs::path& folder) {
  const fs::path output = options.output.empty() ? folder / "results.h5" : options.output;
  const AnalysisChoice choice = analysis_choice(options.analysis);
  const SweepProgress sweep = sweep_progress(folder);
  require_place(output, sweep.files());
  remark_left_out(options.print, folder, sweep);
  ProgressDisplay display(ProgressDisplay::mode(options.print.quiet));
  const AnalysedSweep analysed = analysed_sweep(sweep, choice, shown_on(display));
  display.clear();
  Json runs = Json::array();
  for (std::size_t k = 0; k < analysed.runs.size(); ++k) {
    Json& run = runs.emplace_back(analysis_summary(analysed.runs[k]));
    for (const auto& [key, value] : analysed.values[k]) run["values"][key] = parse_json(value, key);
  }
  const GlassStudy study = glass_study(analysed);
  Results results = results_of_sweep(analysed, study);
  if (!sweep.unfinished.empty()) results.provenance.emplace_back("left_out", sweep.left_out());
  write_all(output, results);
  Json summary = {{"output", output.string()}};
  if (options.print.json)
    summary.update({{"runs", std::move(runs)}, {"glass", glass_summary(study)}});
  else if (!options.print.quiet)
    print_text(glass_text(study));
  print_summary(options.print, summary);
  return success;
}

int list_observables() {
  print_text(observables_page());
  return success;
}

}  // namespace

int analyze_command(const AnalyzeOptions& options) {
  catch_stop_signals(0, StopDeadline::at_once);
  if (options.list) return list_observables();
  if (options.input.empty())
    throw UserError("name a run or the folder of a sweep; --list says what is computed");
  const fs::path input = run_or_sweep(options.input);
  return fs::is_directory(input) ? analyze_sweep(options, input) : analyze_file(options, input);
}

}  // namespace vitrel
