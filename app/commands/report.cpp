#include "app/commands/report.h"

#include <strings.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/progress.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/io/text_file.h"
#include "workflow/analyze/analyze.h"
#include "workflow/report/page.h"
#include "workflow/sweep/sweep.h"

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

/// Beside a state or a run, or in the folder of a sweep, unless the command line says where.
fs::path output_of(const ReportOptions& options, const fs::path& input) {
  if (!options.output.empty()) return options.output;
  return fs::is_directory(input) ? input / "report.html"
                                 : fs::path(input).replace_extension("html");
}

/// What the page is made of, which it must not replace.
std::vector<fs::path> inputs_of(const ReportOptions& options, const fs::path& input) {
  if (fs::is_directory(input)) return sweep_progress(input).files();
  return {input, options.analysis.file};
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
  const fs::path input = run_or_sweep(options.input);
  const fs::path output = output_of(options, input);
  const AnalysisChoice choice = analysis_choice(options.analysis);
  require_place(output, inputs_of(options, input));
  if (fs::is_directory(input)) remark_left_out(options.print, input, sweep_progress(input));
  ProgressDisplay display(ProgressDisplay::mode(options.print.quiet));
  const Page page = page_of(input, choice, shown_on(display));
  display.clear();
  write_text(output, page.html);
  print_summary(options.print, {{"output", output.string()}, {key_of(page.subject), page.count}});
  return success;
}

}  // namespace vitrel
