#include "workflow/report/packing_report.h"

#include <fmt/format.h>

#include "core/io/h5md.h"
#include "workflow/prepare/packing_quality.h"
#include "workflow/prepare/quality_file.h"
#include "workflow/report/run_report.h"

namespace vitrel {

PackingPage packing_page_data(const std::filesystem::path& file, const AnalysisChoice& choice,
                              const AnalysisProgress& progress) {
  const TrajectoryReader reader(file);
  const Configuration3 packing = read_state<3>(file);
  const ExactCheck<3> check = exact_check(packing);
  PackingQuality quality = measure_quality(packing, check);
  const std::filesystem::path report = quality_file(file);
  if (std::filesystem::exists(report)) add_preparation(quality, report);
  const Provenance provenance = reader.provenance();
  PackingPage page;
  page.title = file.stem().string();
  page.subtitle = fmt::format("{} {} at φ = {:.6g}", packing.size(), particles_text(packing),
                              quality.packing_fraction);
  if (reader.frames() > 1)
    page.subtitle +=
        fmt::format("; the last of {} frames, at time {:.6g}", reader.frames(), packing.time);
  page.rows = quality_rows(quality);
  page.scene = packing_scene(packing, check);
  page.results = analyze_run(file, choice, progress).results;
  page.parameters = provenance.parameters;
  page.provenance = provenance_rows(provenance);
  return page;
}

}  // namespace vitrel
