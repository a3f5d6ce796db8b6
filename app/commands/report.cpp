#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/workflow/analyze.h"
#include "app/workflow/quality_file.h"
#include "app/workflow/run_report.h"
#include "app/workflow/sweep_results.h"
#include "app/workflow/text_file.h"

namespace vitrel {

int report_command(const Arguments& arguments) {
  namespace fs = std::filesystem;
  const bool is_sweep = fs::is_directory(arguments.input);
  fs::path output = arguments.output;
  if (output.empty())
    output = is_sweep ? arguments.input / "report.html"
                      : fs::path(arguments.input).replace_extension("html");
  if (!is_sweep && is_single_state(arguments.input)) {
    write_text(output, state_page(state_page_data(arguments.input)));
    print_summary(arguments, {{"output", output.string()}, {"states", 1}});
    return success;
  }
  const AnalysisChoice choice = analysis_choice(arguments);
  const std::vector<AnalysedRun> analyses =
      is_sweep ? analysed_jobs(arguments.input, choice)
               : std::vector<AnalysedRun>{analyze_run(arguments.input, choice)};
  write_text(output, report_page(report_data(analyses, "vitrel")));
  print_summary(arguments, {{"output", output.string()}, {"runs", analyses.size()}});
  return success;
}

}  // namespace vitrel
