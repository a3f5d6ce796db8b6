#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/glass/glass_study.h"
#include "analysis/results.h"
#include "analysis/trajectory.h"
#include "core/io/foreign/foreign_file.h"
#include "core/io/json.h"
#include "core/io/provenance.h"

/// @file
/// The analysis of one saved run.
namespace vitrel {

/// What the command line says about the analysis. Without a parameter file, the parameters stored in the run are
/// used.
struct AnalysisChoice {
  std::optional<std::filesystem::path> parameters;
  std::vector<std::string> overrides;

  /// Whether the command line says anything about the analysis.
  bool given() const { return parameters || !overrides.empty(); }
};

/// What the command line says about a file of another program.
KnownSystem known_system(const AnalysisChoice& choice);

/// Callbacks of an analysis; empty functions are not called.
struct AnalysisProgress {
  std::function<void(const std::string&)> begin = {};  ///< a phase begins: "structure"
  ProgressReport report = {};                          ///< reports the progress of the phase
};

/// A run and its results.
struct AnalysedRun {
  std::filesystem::path file;
  Results results;
  std::optional<GlassRun> glass = {};  ///< if the run can be judged

  /// The name of the job's folder, or of the file if it is in no such folder.
  std::string name() const;
  double packing_fraction() const;
  std::uint64_t seed() const;
};

/// Computes all tables (observable.h) for which the run has the data. Throws FileError or UserError, naming the file.
AnalysedRun analyze_run(const std::filesystem::path& file, const AnalysisChoice& choice,
                        const AnalysisProgress& progress = {});

/// How the file of another program was read; empty for files of vitrel.
ImportReport import_report(const Results& results);

/// The report as a JSON object whose values are texts.
Json import_json(const ImportReport& report);

/// Reads what an earlier analysis of the run wrote into the file `results`. Throws FileError.
AnalysedRun stored_analysis(const std::filesystem::path& run, const std::filesystem::path& results);

/// The file into which `vitrel analyze` writes the results of a run by default.
std::filesystem::path results_path(const std::filesystem::path& run);

/// Returns the results that are already on disk if this version computed them from this run with the same parameters;
/// otherwise analyzes the run as analyze_run does.
AnalysedRun stored_or_analyzed(const std::filesystem::path& file, const AnalysisChoice& choice,
                               const AnalysisProgress& progress = {});

/// The names of the tables of the results in this file; none if the file does not exist. Throws UserError if the file
/// holds anything but the results of an analysis, because new results must not overwrite it.
std::vector<std::string> former_tables(const std::filesystem::path& file);

/// Writes the HDF5 file and, into the folder of that name beside it, all tables as CSV (write_csv_folder). CSV files
/// of tables that only the former results in this file had are removed. Throws FileError, and UserError as
/// former_tables does.
void write_all(const std::filesystem::path& file, const Results& results);

/// All numbers of the summary, and the verdict if the run could be judged.
Json analysis_summary(const AnalysedRun& run);

/// Origin of a file as rows for tables and pages; empty for a file of another program.
std::vector<std::pair<std::string, std::string>> provenance_rows(const Provenance& provenance);

}  // namespace vitrel
