#include "workflow/report/state_report.h"

#include <fmt/format.h>

#include "core/io/h5md.h"
#include "workflow/analyze/analyze.h"
#include "workflow/prepare/quality_file.h"
#include "workflow/report/run_report.h"

namespace vitrel {

StatePage state_page_data(const std::filesystem::path& file) {
  const TrajectoryReader reader(file);
  StatePage page;
  page.state = reader.read(0);
  const Provenance provenance = reader.provenance();
  const Quality quality = read_quality(quality_file(file), page.state);
  page.title = file.stem().string();
  page.subtitle = fmt::format("{} {} at φ = {:.6g}", page.state.size(), particles_text(page.state),
                              quality.packing_fraction);
  page.rows = quality_rows(quality);
  page.nematic_correlation = quality.nematic_correlation;
  page.nematic_order = quality.nematic_order;
  if (quality.decorrelation) {
    page.sweeps = quality.decorrelation->sweeps;
    page.orientation = quality.decorrelation->orientation;
    page.displacement = quality.decorrelation->displacement;
  }
  page.parameters = provenance.parameters;
  page.provenance = provenance_rows(provenance);
  return page;
}

}  // namespace vitrel
