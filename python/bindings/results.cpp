#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/observables/observable.h"
#include "analysis/statistics/blocking.h"
#include "analysis/trajectory.h"
#include "core/io/text_file.h"
#include "python/bindings/arrays.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interruption.h"
#include "workflow/analyze/analyze.h"
#include "workflow/analyze/glass_report.h"
#include "workflow/report/page.h"
#include "workflow/report/page_parts.h"
#include "workflow/report/page_tables.h"
#include "workflow/sweep/sweep_results.h"

namespace vitrel::python {
namespace {

/// The column as (name, unit, values, errors or None, labels).
py::tuple column_of(const Column& column) {
  const py::object errors = column.error.empty()
                                ? py::object(py::none())
                                : py::object(owned(std::vector<double>(column.error)));
  return py::make_tuple(column.name, column.unit, owned(std::vector<double>(column.value)), errors,
                        column.labels);
}

/// The tables as [(name, description, columns)].
py::list tables_of(const Results& results) {
  py::list tables;
  for (const Table& table : results.tables) {
    py::list columns;
    for (const Column& column : table.columns) columns.append(column_of(column));
    tables.append(py::make_tuple(table.name, table.description, columns));
  }
  return tables;
}

AnalysisChoice choice_of(const std::vector<std::string>& overrides) {
  AnalysisChoice choice;
  choice.overrides = overrides;
  return choice;
}

AnalysisProgress until(Interruption& interruption) {
  return {{}, std::ref(interruption)};
}

/// Returns the summary as JSON, the tables, and the provenance as [(name, text)].
py::tuple analyze_file(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides) {
  const AnalysedRun run = [&] {
    const Released released;
    Interruption interruption;
    return analyze_run(file, choice_of(overrides), until(interruption));
  }();
  return py::make_tuple(analysis_summary(run).dump(), tables_of(run.results),
                        run.results.provenance);
}

/// Returns the summary of the glass study as JSON, the tables, the provenance, the files of the finished jobs, and
/// the names of the unfinished jobs.
py::tuple analyze_sweep(const std::filesystem::path& folder,
                        const std::vector<std::string>& overrides) {
  AnalysedSweep analysed;
  GlassStudy study;
  const SweepProgress sweep = sweep_progress(folder);
  {
    const Released released;
    Interruption interruption;
    analysed = analysed_sweep(sweep, choice_of(overrides), until(interruption));
    study = glass_study(analysed);
  }
  std::vector<std::filesystem::path> files;
  for (const AnalysedRun& run : analysed.runs) files.push_back(run.file);
  const Results results = results_of_sweep(analysed, study);
  return py::make_tuple(glass_summary(study).dump(), tables_of(results), results.provenance, files,
                        sweep.unfinished);
}

/// The report page as HTML.
std::string page(const std::filesystem::path& input, const std::vector<std::string>& overrides) {
  const Released released;
  Interruption interruption;
  return page_of(input, choice_of(overrides), until(interruption)).html;
}

void write_page(const std::filesystem::path& input, const std::filesystem::path& output,
                const std::vector<std::string>& overrides) {
  require_place_of_page(output);
  write_text(output, page(input, overrides));
}

/// The mean and standard error of a series. The error is NaN if the series is not evenly spaced in time.
py::tuple average(const Doubles& time, const Doubles& value) {
  const std::size_t n = require_rows(time, 0, "time");
  require_rows(value, 0, "value", n);
  const Estimate estimate = slow_average({value.data(), n});
  return py::make_tuple(estimate.mean, evenly_spaced({time.data(), n})
                                           ? estimate.error
                                           : std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

void bind_results(py::module_& module) {
  module.def("analyze", &analyze_file, py::arg("file"), py::arg("overrides"));
  module.def("analyze_sweep", &analyze_sweep, py::arg("folder"), py::arg("overrides"));
  module.def("page", &page, py::arg("input"), py::arg("overrides"));
  module.def("write_page", &write_page, py::arg("input"), py::arg("output"), py::arg("overrides"));
  module.def("average", &average, py::arg("time"), py::arg("value"));
  module.def(
      "unit_name",
      [](const std::string& unit, int dimension) { return unit_name(unit, page_units(dimension)); },
      py::arg("unit"), py::arg("dimension"));
  module.def(
      "charts",
      [](int dimension) {
        std::vector<Observable> all = observables(dimension);
        all.push_back(jobs_observable());
        return charts_data(all).dump();
      },
      py::arg("dimension"));
}

}  // namespace vitrel::python
