#include "workflow/report/page.h"

#include <strings.h>

#include <fstream>
#include <string_view>

#include "core/error.h"
#include "core/io/h5md.h"
#include "workflow/report/run_report.h"
#include "workflow/report/state_report.h"
#include "workflow/sweep/sweep.h"
#include "workflow/sweep/sweep_results.h"

namespace vitrel {
namespace {

Page page_of_sweep(const std::filesystem::path& folder, const AnalysisChoice& choice,
                   const AnalysisProgress& progress) {
  const SweepProgress sweep = sweep_progress(folder);
  ReportData data = report_data(analysed_sweep(sweep, choice, progress));
  if (!sweep.unfinished.empty()) {
    data.subtitle += "; " + sweep.share();
    data.provenance.emplace_back("left_out", sweep.left_out());
  }
  return {PageSubject::sweep, sweep.finished.size(), report_page(data)};
}

Page page_of_state(const std::filesystem::path& file, const AnalysisChoice& choice) {
  const KnownSystem known = known_system(choice);
  if (choice.given() && !TrajectoryReader(file, known).units())
    throw UserError(file.string() +
                    ": is a single state, whose page holds no analysis; leave out --params and "
                    "--set");
  return {PageSubject::state, 1, state_page(state_page_data(file, known))};
}

bool is_page(const std::filesystem::path& file) {
  constexpr std::string_view beginning = "<!doctype html";
  std::string found(beginning.size(), ' ');
  std::ifstream(file, std::ios::binary).read(found.data(), std::ssize(found));
  return strncasecmp(found.data(), beginning.data(), beginning.size()) == 0;
}

}  // namespace

PageSubject page_subject(const std::filesystem::path& input, const AnalysisChoice& choice) {
  if (std::filesystem::is_directory(input)) return PageSubject::sweep;
  const TrajectoryReader reader(input, known_system(choice));
  if (reader.frames() != 1) return PageSubject::run;
  return reader.dimension() == 3 ? PageSubject::packing : PageSubject::state;
}

Page page_of(const std::filesystem::path& input, const AnalysisChoice& choice,
             const AnalysisProgress& progress) {
  const PageSubject subject = page_subject(input, choice);
  switch (subject) {
    case PageSubject::sweep:
      return page_of_sweep(input, choice, progress);
    case PageSubject::state:
      return page_of_state(input, choice);
    case PageSubject::packing:
      return {subject, 1, state_page(packing_page_data(input, choice, progress))};
    case PageSubject::run:
      return {subject, 1,
              report_page(
                  report_data(stored_or_analyzed(input, choice, progress), known_system(choice)))};
  }
  return {};
}

void require_place_of_page(const std::filesystem::path& output) {
  if (std::filesystem::exists(output) && !is_page(output))
    throw UserError(
        output.string() +
        ": exists and is not an HTML page, which alone a page may replace; choose another output, "
        "or delete it");
}

}  // namespace vitrel
