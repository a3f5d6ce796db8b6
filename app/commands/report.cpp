#include "app/commands/report.h"

#include <strings.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/progress.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "core/io/json.h"
#include "core/io/text_file.h"
#include "workflow/analyze/analyze.h"
#include "workflow/report/packing_report.h"
#include "workflow/report/run_report.h"
#include "workflow/report/state_report.h"
#include "workflow/sweep/sweep.h"
#include "workflow/sweep/sweep_results.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

bool is_page(const fs::path& file) {
  constexpr std::string_view beginning = "<!doctype html";
  std::string found(beginning.size(), ' ');
  std::ifstream(file, std::ios::binary).read(found.data(), std::ssize(found));
  return strncasecmp(found.data(), beginning.data(), beginning.size()) == 0;
}

/// Where a page goes must be free, or a page.
void require_place(const fs::path& output, const std::vector<fs::path>& inputs) {
  require_output_file(output, inputs);
  if (fs::exists(output) && !is_page(output))
    throw UserError(
        output.string() +
        ": exists and is not an HTML page; vitrel report overwrites nothing else; choose "
        "another output, or delete it");
}

int write_page(const ReportOptions& options, const fs::path& output, const std::string& text,
               const Json& about) {
  write_text(output, text);
  Json summary = {{"output", output.string()}};
  summary.update(about);
  print_summary(options.print, summary);
  return success;
}

/// Beside a state or a run, unless the command line says where.
fs::path output_of(const ReportOptions& options, const fs::path& file) {
  return options.output.empty() ? fs::path(file).replace_extension("html") : options.output;
}

int report_state(const ReportOptions& options) {
  if (analysis_choice(options.analysis).given())
    throw UserError(options.input.string() +
                    ": is a single state, whose page holds no analysis; leave out --params and "
                    "--set");
  const fs::path output = output_of(options, options.input);
  require_place(output, {options.input});
  return write_page(options, output, state_page(state_page_data(options.input)), {{"states", 1}});
}

int report_packing(const ReportOptions& options, const fs::path& packing) {
  const fs::path output = output_of(options, packing);
  const AnalysisChoice choice = analysis_choice(options.analysis);
  require_place(output, {packing, options.analysis.file});
  ProgressDisplay display(ProgressDisplay::mode(options.print.quiet));
  const PackingPage page = packing_page_data(packing, choice, shown_on(display));
  display.clear();
  return write_page(options, output, packing_page(page), {{"packings", 1}});
}

int report_run(const ReportOptions& options, const fs::path& run) {
  const fs::path output = output_of(options, run);
  const AnalysisChoice choice = analysis_choice(options.analysis);
  require_place(output, {run, options.analysis.file});
  ProgressDisplay display(ProgressDisplay::mode(options.print.quiet));
  const ReportData data = report_data({stored_or_analyzed(run, choice, shown_on(display))});
  display.clear();
  return write_page(options, output, report_page(data), {{"runs", 1}});
}

int report_sweep(const ReportOptions& options, const fs::path& folder) {
  const fs::path output = options.output.empty() ? folder / "report.html" : options.output;
  const AnalysisChoice choice = analysis_choice(options.analysis);
  const SweepProgress sweep = sweep_progress(folder);
  require_place(output, sweep.files());
  remark_left_out(options.print, folder, sweep);
  ProgressDisplay display(ProgressDisplay::mode(options.print.quiet));
  ReportData data = report_data(analysed_jobs(sweep, choice, shown_on(display)));
  display.clear();
  if (!sweep.unfinished.empty()) {
    data.subtitle += "; " + sweep.share();
    data.provenance.emplace_back("left_out", sweep.left_out());
  }
  return write_page(options, output, report_page(data), {{"runs", sweep.finished.size()}});
}

}  // namespace

int report_command(const ReportOptions& options) {
  const fs::path input = run_or_sweep(options.input);
  if (fs::is_directory(input)) return report_sweep(options, input);
  const TrajectoryReader reader(input);
  if (reader.frames() != 1) return report_run(options, input);
  return reader.dimension() == 3 ? report_packing(options, input) : report_state(options);
}

}  // namespace vitrel
