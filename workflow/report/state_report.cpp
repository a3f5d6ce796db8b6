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

StructureOptions structure_options(const Provenance& provenance, const std::string& file) {
  if (provenance.parameters.empty()) return {};
  return parse_parameters(provenance.parameters, file).structure;
}

/// S(q) and g(r); the page has the correlation of orientations in bins wide enough for a single state, in which
/// g(r, θ) would be noise.
std::vector<Table> structure(const Configuration2& state, const StructureOptions& options) {
  MemoryTrajectory2 trajectory({state});
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

}  // namespace

StatePage state_page_data(const std::filesystem::path& file, const KnownSystem& known) {
  const TrajectoryReader reader(file, known);
  StatePage page;
  page.state = reader.read(0);
  const Provenance provenance = reader.provenance();
  const Quality quality = read_quality(quality_file(file), page.state);
  page.title = file.stem().string();
  page.subtitle = fmt::format("{} {} at φ = {:.6g}", page.state.size(), particles_text(page.state),
                              quality.packing_fraction);
  page.rows = quality_rows(quality);
  page.structure.tables = structure(page.state, structure_options(provenance, file.string()));
  page.nematic_correlation = quality.nematic_correlation;
  page.nematic_order = quality.nematic_order;
  if (quality.decorrelation) {
    page.sweeps = quality.decorrelation->sweeps;
    page.orientation = quality.decorrelation->orientation;
    page.displacement = quality.decorrelation->displacement;
  }
  page.parameters = provenance.parameters;
  page.provenance = provenance_rows(provenance);
  page.units = reader.units();
  return page;
}

}  // namespace vitrel
