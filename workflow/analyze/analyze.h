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

/// What the command line says; without a file of its own the parameters stored in the run are used.
struct AnalysisChoice {
  std::optional<std::filesystem::path> parameters;
  std::vector<std::string> overrides;

  /// Whether it says anything about the analysis.
  bool given() const { return parameters || !overrides.empty(); }
};

/// What it says about files of other programs.
KnownSystem known_system(const AnalysisChoice& choice);

/// Callbacks of an analysis; empty functions are not called.
struct AnalysisProgress {
  std::function<void(const std::string&)> begin = {};  ///< a phase begins: "structure"
  ProgressReport report = {};                          ///< how far the phase is
};

/// A run and its results.
struct AnalysedRun {
  std::filesystem::path file;
  Results results;
  std::optional<GlassRun> glass = {};  ///< of a run that can be judged

  /// That of the job's folder, or of the file.
  std::string name() const;
  double packing_fraction() const;
  std::uint64_t seed() const;
};

/// All tables (observable.h) of which the run has what they need. Throws FileError or UserError, naming the file.
AnalysedRun analyze_run(const std::filesystem::path& file, const AnalysisChoice& choice,
                        const AnalysisProgress& progress = {});

/// How the file of another program was read; empty for those of vitrel.
ImportReport import_report(const Results& results);

/// An object of texts.
Json import_json(const ImportReport& report);

/// The same as an earlier analysis wrote it into this file. Throws FileError.
AnalysedRun stored_analysis(const std::filesystem::path& run, const std::filesystem::path& results);

/// Where `vitrel analyze` writes the results of a run by default.
std::filesystem::path results_path(const std::filesystem::path& run);

/// The results that are there already if this version computed them from this run with the same parameters;
/// else as analyze_run.
AnalysedRun stored_or_analyzed(const std::filesystem::path& file, const AnalysisChoice& choice,
                               const AnalysisProgress& progress = {});

/// The tables of the results in this file, if there is one. Throws UserError if it holds anything but
/// the results of an analysis, for which these must not take its place.
std::vector<std::string> former_tables(const std::filesystem::path& file);

/// Writes the HDF5 file and, into the folder of that name beside it, all tables as CSV (write_csv_folder);
/// those of tables that only the former results in this file had are removed. Throws FileError, and UserError like
/// former_tables.
void write_all(const std::filesystem::path& file, const Results& results);

/// All numbers of the summary, and the verdict.
Json analysis_summary(const AnalysedRun& run);

/// Where a file comes from, as tables and pages give it; nothing of one of another program.
std::vector<std::pair<std::string, std::string>> provenance_rows(const Provenance& provenance);

}  // namespace vitrel
