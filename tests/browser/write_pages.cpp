#include <cstdio>
#include <exception>
#include <filesystem>

#include "app/workflow/report/state_page.h"
#include "app/workflow/text_file.h"
#include "tests/support/report_example.h"

// write_pages <folder>: the pages that the browser opens, from made-up results.
namespace vitrel {
namespace {

StatePage state() {
  MemoryTrajectory trajectory = report_example::lattice(5, 1);
  StatePage page;
  page.title = "state";
  page.rows = {{"packing fraction", "0.196", ""}};
  page.state = trajectory.read(0);
  page.nematic_correlation = {{0.5, 1.5, 2.5}, {0.5, 0.25, 0.125}, {5, 20, 50}};
  page.nematic_order = 0.3;
  page.sweeps = {1, 2, 4};
  page.orientation = {0.9, 0.8, 0.7};
  page.displacement = {0.1, 0.2, 0.3};
  return page;
}

ReportData one_run() {
  ReportData data = report_example::sweep(2, 1);
  data.runs = {report_example::run(0.7, report_example::lattice(8, 20))};
  data.study = {};
  std::vector<Table>& tables = data.runs.front().results.tables;
  tables.push_back({"on_the_fly_all",
                    "",
                    {report_example::plain("time", "time", {1, 2, 4}),
                     report_example::plain("msd", "length^2", {0.1, 0.2, 0.4}),
                     report_example::plain("fs_1", "1", {0.9, 0.8, 0.6})}});
  tables.push_back(
      {"on_the_fly_wave_numbers",
       "",
       {report_example::plain("index", "1", {1}), report_example::plain("q", "1/length", {3.1})}});
  return data;
}

void write_pages(const std::filesystem::path& folder) {
  ReportData sweep = report_example::sweep(6, 12);
  MemoryTrajectory final_state = report_example::lattice(6, 1);
  sweep.runs[1].movie = film(final_state);
  write_text(folder / "sweep.html", report_page(sweep));
  write_text(folder / "run.html", report_page(one_run()));
  write_text(folder / "state.html", state_page(state()));
  ReportData large = report_example::sweep(2, 1);
  large.runs = {report_example::run(0.7, report_example::lattice(32, 200))};
  write_text(folder / "large.html", report_page(large));
  ReportData bare;
  bare.runs.resize(1);
  write_text(folder / "bare.html", report_page(bare));
}

}  // namespace
}  // namespace vitrel

int main(int, char** arguments) {
  try {
    vitrel::write_pages(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_pages: %s\n", error.what());
    return 1;
  }
}
