#include "workflow/report/packing_report.h"

#include <fmt/format.h>

#include "core/io/h5md.h"
#include "workflow/prepare/quality.h"
#include "workflow/report/run_report.h"

namespace vitrel {

namespace {

constexpr std::size_t max_particles = 10'000;

}  // namespace

PackingPage packing_page_data(const std::filesystem::path& file, const AnalysisChoice& choice,
                              const AnalysisProgress& progress) {
  const TrajectoryReader reader(file, known_system(choice));
  const Configuration3 packing = read_state<3>(reader);
  const ExactCheck<3> check = exact_check(packing);
  PackingQuality quality = measure_quality(packing, check);
  const std::filesystem::path report = quality_file(file);
  if (std::filesystem::exists(report)) add_preparation(quality, report);
  const Provenance provenance = reader.provenance();
  PackingPage page;
  page.title = fmt::format("Packing of {} {}", packing.size(), particles_text(packing));
  page.subtitle = fmt::format("{}, φ = {:.6g}", file.stem().string(), quality.packing_fraction);
  page.rows = quality_rows(quality);
  MemoryTrajectory3 state({packing});
  page.movie = film(state, {.particles = max_particles});
  page.results = analyze_run(file, choice, progress).results;
  page.parameters = provenance.parameters;
  page.provenance = provenance_rows(provenance);
  page.units = reader.units();
  return page;
}

}  // namespace vitrel
