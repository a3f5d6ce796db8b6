#pragma once

#include <string>
#include <vector>

#include "analysis/observables/observable.h"
#include "analysis/results.h"
#include "core/io/json.h"

/// @file
/// Tables of results in the form in which pages contain and show them.
namespace vitrel {

/// The largest number of rows that tables keep.
struct Thinning {
  double rows_per_decade = 20;  ///< for correlations, whose first column is the time
  /// The limit for energies, compressibility_factor, order and all other tables, which are thinned evenly.
  std::size_t max_rows = 400;
};

/// The tables for the script, by name. Each has its columns by name, with unit, value and, if there is one, error,
/// and the stride by which evenly spaced rows were thinned. Tables that no chart needs are left out.
Json tables_data(const Results& results, const std::vector<Observable>& observables,
                 const Thinning& thinning = {});

/// One table with all its rows, in which codes are replaced by their meanings.
Json table_data(const Table& table);

/// The charts of all these tables for the script, with all members of Chart.
Json charts_data(const std::vector<Observable>& observables);

/// A packing fraction with two decimals if these are exact, else with four: 0.50, 0.7125.
std::string density_text(double phi);

/// The number in this row of a column, with its error: "1.234 ± 0.012". The text is "–" if the table, the column or
/// the row is missing.
std::string table_text(const Results& results, const std::string& table, const std::string& column,
                       std::size_t row = 0);
/// The number in this row of a column; NaN if it is missing.
double table_value(const Results& results, const std::string& table, const std::string& column,
                   std::size_t row = 0);

}  // namespace vitrel
