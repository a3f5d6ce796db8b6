#include "workflow/report/state_report.h"

#include <fmt/format.h>

#include "analysis/observables/frame_observable.h"
#include "core/io/h5md.h"
#include "workflow/analyze/analyze.h"
#include "workflow/configuration/parameters.h"
#include "workflow/prepare/quality.h"
#include "workflow/report/run_report.h"

namespace vitrel {
namespace {

StructureOptions structure_options(const std::string& parameters, const std::string& file) {
  if (parameters.empty()) return {};
  return parse_parameters(parameters, file).structure;
}

/// The tables of S(q) and g(r). For the correlation of orientations the page uses bins wide enough for a single
/// state, since g(r, θ) would be noise.
std::vector<Table> structure(MemoryTrajectory2& trajectory, const StructureOptions& options) {
  std::vector<Table> tables =
      measure_frames(trajectory, options, all_cores, {}, {"structure_factor", "pair_correlation"})
          .tables;
  std::erase_if(tables,
                [](const Table& table) { return table.name == "pair_correlation_by_angle"; });
  for (Table& table : tables)
    std::erase_if(table.columns, [](const Column& column) {
      return column.name == "g_2" || column.name == "g_4";
    });
  return tables;
}

/// A page with the parameters, provenance and units that the file states.
StatePage page_of_file(const TrajectoryReader& reader) {
  const Provenance provenance = reader.provenance();
  StatePage page;
  page.parameters = provenance.parameters;
  page.provenance = provenance_rows(provenance);
  page.units = reader.units();
  return page;
}

}  // namespace

StatePage state_page_data(const std::filesystem::path& file, const KnownSystem& known) {
  const TrajectoryReader reader(file, known);
  StatePage page = page_of_file(reader);
  const Configuration2 state = reader.read(0);
  const Quality quality = read_quality(quality_file(file), state);
  page.title = file.stem().string();
  page.subtitle = fmt::format("{} {} at φ = {:.6g}", state.size(), particles_text(state),
                              quality.packing_fraction);
  page.rows = quality_rows(quality);
  MemoryTrajectory2 trajectory({state});
  page.movie = film(trajectory);
  page.structure.tables = structure(trajectory, structure_options(page.parameters, file.string()));
  page.nematic_correlation = quality.nematic_correlation;
  page.nematic_order = quality.nematic_order;
  if (quality.decorrelation) {
    page.sweeps = quality.decorrelation->sweeps;
    page.orientation = quality.decorrelation->orientation;
    page.displacement = quality.decorrelation->displacement;
  }
  return page;
}

StatePage packing_page_data(const std::filesystem::path& file, const AnalysisChoice& choice,
                            const AnalysisProgress& progress) {
  const TrajectoryReader reader(file, known_system(choice));
  StatePage page = page_of_file(reader);
  const Configuration3 packing = read_state<3>(reader);
  PackingQuality quality = measure_quality(packing, exact_check(packing));
  const std::filesystem::path report = quality_file(file);
  if (std::filesystem::exists(report)) add_preparation(quality, report);
  page.title = fmt::format("Packing of {} {}", packing.size(), particles_text(packing));
  page.subtitle = fmt::format("{}, φ = {:.6g}", file.stem().string(), quality.packing_fraction);
  page.rows = quality_rows(quality);
  MemoryTrajectory3 trajectory({packing});
  page.movie = film(trajectory, {.particles = 10'000});
  page.structure = analyze_run(file, choice, progress).results;
  return page;
}

}  // namespace vitrel
