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
/// The report: one HTML page that needs nothing beside it, neither files nor a network.
namespace vitrel {

/// One run, as the page shows it. What is not known stays empty or NaN and is not shown, or as "–".
struct ReportRun {
  std::string name;      ///< of its file or folder
  std::string label;     ///< what tells it from the others: "φ = 0.5, seed 1"
  std::string dynamics;  ///< "Brownian, step 0.1"; empty for a state
  double packing_fraction = 0;
  Results results;                 ///< tables by name: summary, displacements_all, energies …
  AnyMovie movie;                  ///< of the same dimension for all runs
  PageProvenance provenance = {};  ///< the same names for all runs
  std::optional<Cooling> cooling = {};
};

/// A column of the table `runs` of the study, or of its averages, that the sweep runs through.
struct ReportAxis {
  std::string column, symbol;
  std::string name;  ///< in words: "packing fraction"
};

struct ReportData {
  std::string title;
  std::string subtitle;         ///< one line below it: what was simulated
  std::vector<ReportRun> runs;  ///< shown in this order
  Results study = {};           ///< tables over all runs: runs, seeds, relaxation, glass_fit; notes
  std::vector<ReportAxis> axes =
      {};                     ///< the last one is the abscissa; empty: the packing fraction is
  std::string parameters;     ///< TOML text
  PageProvenance provenance;  ///< of the page, beside that of its runs
  std::optional<FileUnits> units = {};  ///< of a file of another program
};

/// The page as HTML. Of one run: the temperature if it is a gas that cools, verdict and relaxation times, the
/// moving particles, correlations, structure, series over time. Of several: what depends on what the sweep runs through,
/// a curve for every combination of the axes but the last; correlations and structure of all, and folded the series of
/// one. Then a table of the runs, parameters, provenance. A chart (observable.h) is there if its table is; relaxation times
/// over the packing fraction are shown with the fits to them (glass_rows.h), if the sweep runs through nothing else.
///
/// To stay small, tables are thinned (page_tables.h), and movies are what film (movie.h) made of
/// them; the page says where it shows a part only. If the page has more than 2 MB, which many runs
/// can do, all tables of runs are thinned in steps of a quarter, down to about 5 rows a decade and 100 rows evenly.
std::string report_page(const ReportData& data);

}  // namespace vitrel
