#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/results.h"
#include "core/io/foreign/foreign_frame.h"
#include "workflow/report/cooling.h"
#include "workflow/report/html.h"
#include "workflow/report/movie.h"

/// @file
/// The report: a single HTML page that needs neither other files nor a network.
namespace vitrel {

/// One run on the page. Values that are not known are empty or NaN; they are left out or shown as "–".
struct ReportRun {
  std::string name;      ///< of its file or folder
  std::string label;     ///< distinguishes it from others: "φ = 0.5, seed 1"
  std::string dynamics;  ///< "Brownian, step 0.1"; empty for a state
  double packing_fraction = 0;
  Results results;                 ///< tables by name: summary, displacements_all, energies …
  AnyMovie movie;                  ///< of the same dimension in all runs
  PageProvenance provenance = {};  ///< has the same names in all runs
  std::optional<Cooling> cooling = {};
};

/// A column through which the sweep runs, of the table `runs` of the study or of its averages.
struct ReportAxis {
  std::string column, symbol;
  std::string name;  ///< in words: "packing fraction"
};

struct ReportData {
  std::string title;
  std::string subtitle;         ///< one line below the title: what was simulated
  std::vector<ReportRun> runs;  ///< shown in this order
  Results study = {};           ///< tables over all runs: runs, seeds, relaxation, glass_fit; notes
  /// The last one is the abscissa. If there are none, the packing fraction is the abscissa.
  std::vector<ReportAxis> axes = {};
  std::string parameters;               ///< TOML text
  PageProvenance provenance;            ///< of the page, in addition to that of its runs
  std::optional<FileUnits> units = {};  ///< of a file of another program
};

/// The page as HTML. For one run it shows the temperature of a gas that cools, verdict and relaxation times, the
/// moving particles, correlations, structure, and series over time. For several runs it shows quantities over the
/// parameters of the sweep, with a curve for every combination of the axes but the last; correlations and structure
/// of all runs; and, folded, the series of one run. A table of the runs, the parameters and the provenance follow. A
/// chart (observable.h) is shown if its table exists. Relaxation times over the packing fraction are shown with the
/// fits to them (glass_rows.h) if the sweep runs through nothing else.
///
/// To keep the page small, tables are thinned (page_tables.h), and movies have the limits of film (movie.h); the page
/// says where it shows only a part. If the page exceeds 2 MB, as it can with many runs, all tables of runs are
/// thinned further in steps of a quarter, down to about 5 rows per decade and 100 evenly spaced rows.
std::string report_page(const ReportData& data);

}  // namespace vitrel
