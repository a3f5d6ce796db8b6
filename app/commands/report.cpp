#include <strings.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/commands/common.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "workflow/analyze/analyze.h"
#include "workflow/prepare/quality_file.h"
#include "workflow/report/packing_report.h"
#include "workflow/report/run_report.h"
#include "workflow/storage/text_file.h"
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
    throw UserError(output.string() +
                    ": exists and is no HTML page, which are all that vitrel report overwrites; "
                    "choose another output, or delete it");
}

int write_page(const Arguments& arguments, const fs::path& output, const std::string& text,
               const nlohmann::ordered_json& about) {
  write_text(output, text);
  nlohmann::ordered_json summary = {{"output", output.string()}};
  summary.update(about);
  print_summary(arguments, summary);
  return success;
}

/// Beside a state or a run, unless the command line says where.
fs::path output_of(const Arguments& arguments, const fs::path& file) {
  return arguments.output.empty() ? fs::path(file).replace_extension("html") : arguments.output;
}

int report_state(const Arguments& arguments) {
  if (analysis_choice(arguments).given())
    throw UserError(arguments.input.string() +
                    ": is a single state, whose page holds no analysis; leave out --params and "
                    "--set");
  const fs::path output = output_of(arguments, arguments.input);
  require_place(output, {arguments.input});
  return write_page(arguments, output, state_page(state_page_data(arguments.input)),
                    {{"states", 1}});
}

int report_packing(const Arguments& arguments, const fs::path& packing) {
  const fs::path output = output_of(arguments, packing);
  const AnalysisChoice choice = analysis_choice(arguments);
  require_place(output, {packing, arguments.parameters});
  return write_page(arguments, output, packing_page(packing_page_data(packing, choice)),
                    {{"packings", 1}});
}

int report_run(const Arguments& arguments, const fs::path& run) {
  const fs::path output = output_of(arguments, run);
  const AnalysisChoice choice = analysis_choice(arguments);
  require_place(output, {run, arguments.parameters});
  const ReportData data = report_data({analyze_run(run, choice)}, "vitrel");
  return write_page(arguments, output, report_page(data), {{"runs", 1}});
}

int report_sweep(const Arguments& arguments, const fs::path& folder) {
  const fs::path output = arguments.output.empty() ? folder / "report.html" : arguments.output;
  const AnalysisChoice choice = analysis_choice(arguments);
  const SweepProgress sweep = sweep_progress(folder);
  require_place(output, sweep.files());
  remark_left_out(arguments, sweep);
  ReportData data = report_data(analysed_jobs(sweep, choice), "vitrel");
  if (!sweep.unfinished.empty()) {
    data.subtitle += "; " + sweep.share();
    data.provenance.emplace_back("left_out", sweep.left_out());
  }
  return write_page(arguments, output, report_page(data), {{"runs", sweep.finished.size()}});
}

}  // namespace

int report_command(const Arguments& arguments) {
  const fs::path input = run_or_sweep(arguments.input);
  if (fs::is_directory(input)) return report_sweep(arguments, input);
  if (TrajectoryReader(input).dimension() == 3) return report_packing(arguments, input);
  return is_single_state(input) ? report_state(arguments) : report_run(arguments, input);
}

}  // namespace vitrel
