#pragma once

#include <limits>
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
  std::string name;      ///< of its file or folder, to tell runs of equal density apart
  std::string dynamics;  ///< "Brownian, step 0.1"
  double packing_fraction = 0;
  double collisions_per_second = std::numeric_limits<double>::quiet_NaN();
  Results results;                 ///< tables by name: summary, displacements_all, energies …
  AnyMovie movie;                  ///< of the same dimension for all runs
  PageProvenance provenance = {};  ///< the same names for all runs
  std::optional<Cooling> cooling = {};
};

struct ReportData {
  std::string title;
  std::string subtitle;                 ///< one line below it: what was simulated
  std::vector<ReportRun> runs;          ///< shown in this order
  Results study = {};                   ///< tables over all runs: relaxation, glass_fit; notes
  std::string parameters;               ///< TOML text
  PageProvenance provenance;            ///< of the page, beside that of its runs
  std::optional<FileUnits> units = {};  ///< of a file of another program
};

/// The page as HTML. Of one run: the temperature if it is a gas that cools, verdict and relaxation times, the
/// moving particles, correlations, structure, series over time. Of several: what depends on the packing
/// fraction, correlations and structure of all, and folded the series of one. Then a table of the runs, parameters, provenance.
/// A chart (observable.h) is there if its table is; of the study, relaxation and glass_fit (glass_rows.h).
///
/// To stay small, tables are thinned (page_tables.h), and movies are what film (movie.h) made of
/// them; the page says where it shows a part only. If the page has more than 2 MB, which many runs
/// can do, all tables of runs are thinned in steps of a quarter, down to about 5 rows a decade and 100 rows evenly.
std::string report_page(const ReportData& data);

}  // namespace vitrel
