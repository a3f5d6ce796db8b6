#pragma once

#include <string>
#include <vector>

#include "analysis/results.h"
#include "workflow/report/page_parts.h"

/// @file
/// The table of runs as HTML.
namespace vitrel {

/// What the table shows: a run in each row, and what the sweep runs through in its first columns.
struct RunsTable {
  const Table& values;               ///< with a row for every run, such as `runs` of a sweep
  std::vector<std::string> keys;     ///< names of the first columns
  std::vector<std::string> symbols;  ///< of these
  std::vector<std::string> names;    ///< of the runs
};

/// Its heading in two rows, symbols and units. Quantities that no run has are left out, and so is the seed if all have
/// the same.
std::string runs_heading(const RunsTable& table, const PageUnits& units);
std::string runs_rows(const RunsTable& table);

}  // namespace vitrel
