#pragma once

#include <filesystem>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/energy.h"
#include "analysis/results.h"
#include "app/workflow/dynamics_tables.h"
#include "app/workflow/glass_study.h"
#include "app/workflow/parameters.h"
#include "app/workflow/progress.h"
#include "app/workflow/report/report_page.h"
#include "core/io/provenance.h"

/// The analysis of saved runs: of one file, or of all finished jobs of a sweep.
namespace vitrel {

struct RunAnalysis {
  std::filesystem::path file;
  Provenance provenance;
  std::optional<Parameters> parameters;  ///< those in the file; none in files of other programs
  double packing_fraction = 0;
  std::size_t particles = 0, rotors = 0, frames = 0;
  double duration = 0;
  std::uint64_t collisions = 0;
  double collisions_per_second = std::numeric_limits<
      double>::quiet_NaN();  ///< of wall time, over the whole run; NaN if not recorded
  RunDynamics dynamics;
  EnergySeries energy;
  CompressibilitySeries compressibility;
  DiffusionCoefficient diffusion{}, rotational_diffusion{};  ///< of all particles
  Configuration2 final_state;
  std::vector<Table> structure;   ///< see structure_tables.h
  std::optional<GlassRun> glass;  ///< none if it cannot be judged (glass_data.h)
  std::vector<Table> on_the_fly;  ///< what the run measured itself (correlations_file.h)
};

/// What the command line says; without a file of its own the parameters stored in the run are used.
struct AnalysisChoice {
  std::optional<std::filesystem::path> parameters;
  std::vector<std::string> overrides;
  ProgressDisplay::Mode progress = ProgressDisplay::Mode::silent;
};

/// Throws FileError or UserError, naming the file.
RunAnalysis analyze_run(const std::filesystem::path& file, const AnalysisChoice& choice);

/// Tables of time correlations (dynamics_tables.h), energies, compressibility, structure, correlations measured
/// on the fly, and a summary of one row.
Results results_of(const RunAnalysis& run);
/// Relaxation times and verdicts of the runs that can be judged, and fits of the laws of the glass
/// transition to them.
GlassStudy glass_study(const std::vector<RunAnalysis>& runs);
/// One row per run: packing fraction, compressibility, diffusion coefficients; and the glass study.
Results results_of_sweep(const std::vector<RunAnalysis>& runs);

/// Writes the HDF5 file and beside it one CSV file per table, <name>_<table>.csv.
void write_all(const std::filesystem::path& file, const Results& results);

nlohmann::ordered_json analysis_summary(const RunAnalysis& run);

/// Where a file comes from, as tables and pages give it.
PageProvenance provenance_rows(const Provenance& provenance);
/// "ellipses, κ = 2" for equal particles, else "particles of species A, B".
std::string particles_text(const Configuration2& state);

/// The report's view of these runs. Reads the files again, for the movies: one run has 200 000 poses
/// in its movie; of several, six spread over the densities share half as many, and the others show
/// their final state.
ReportData report_data(const std::vector<RunAnalysis>& runs, const std::string& title);

}  // namespace vitrel
