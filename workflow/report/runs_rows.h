#pragma once

#include <string>
#include <vector>

#include "analysis/results.h"
#include "workflow/report/page_parts.h"

/// @file
/// The table of runs as HTML.
namespace vitrel {

/// The content of the table: one run per row, with the parameters of the sweep in the first columns.
struct RunsTable {
  const Table& values;               ///< has a row for every run, as the table `runs` of a sweep
  std::vector<std::string> keys;     ///< names of the first columns
  std::vector<std::string> symbols;  ///< of the first columns
  std::vector<std::string> names;    ///< of the runs
};

/// The heading in two rows, with symbols and units. Quantities that no run has are left out, and so is the seed if
/// all runs have the same.
std::string runs_heading(const RunsTable& table, const PageUnits& units);
std::string runs_rows(const RunsTable& table);

}  // namespace vitrel
