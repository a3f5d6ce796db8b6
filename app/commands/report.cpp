#include "app/commands/commands.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/progress.h"
#include "app/terminal/stop_signals.h"
#include "core/io/text_file.h"
#include "workflow/analyze/analyze.h"
#include "workflow/report/page.h"
#include "workflow/sweep/sweep.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

/// The output is beside a state or a run, or in the folder of a sweep, unless the user names it.
fs::path output_of(const ReportOptions& options, const fs::path& input) {
  if (!options.output.empty()) return options.output;
  return fs::is_directory(input) ? input / "report.html"
                                 : fs::path(input).replace_extension("html");
}

const char* key_of(PageSubject subject) {
  switch (subject) {
    case PageSubject::state:
      return "states";
    case PageSubject::packing:
      return "packings";
    default:
      return "runs";
  }
}

}  // namespace

int report_command(const ReportOptions& options) {
  catch_stop_signals(0, StopDeadline::at_once);
  const fs::path input = run_or_sweep(options.input);
  const fs::path output = output_of(options, input);
  const AnalysisChoice choice = analysis_choice(options.analysis);
  std::vector<fs::path> inputs = {input, options.analysis.file};
  if (fs::is_directory(input)) {
    const SweepProgress sweep = sweep_progress(input);
    inputs = sweep.files();
    remark_left_out(options.print, input, sweep);
  }
  require_output_file(output, inputs);
  require_place_of_page(output);
  ProgressDisplay display(ProgressDisplay::mode(options.print.quiet));
  const Page page = page_of(input, choice, shown_on(display));
  display.clear();
  write_text(output, page.html);
  print_summary(options.print, {{"output", output.string()}, {key_of(page.subject), page.count}});
  return success;
}

}  // namespace vitrel
