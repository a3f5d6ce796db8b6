#pragma once

#include <string>
#include <vector>

#include "analysis/observables/observable.h"
#include "analysis/results.h"
#include "core/io/json.h"

/// @file
/// Tables of results, as the pages carry and show them.
namespace vitrel {

/// How many rows tables keep at most.
struct Thinning {
  double rows_per_decade = 20;  ///< of correlations, whose first column is the time
  std::size_t max_rows =
      400;  ///< evenly, of energies, compressibility_factor, order and all others
};

/// For the script: a table by its name; in it the columns by theirs, with unit, value and error (if
/// there is any), and the stride that evenly spaced rows were thinned by. Tables that no chart needs stay
/// out.
Json tables_data(const Results& results, const std::vector<Observable>& observables,
                 const Thinning& thinning = {});

/// One table with all its rows, codes as what they stand for.
Json table_data(const Table& table);

/// For the script: the charts of all these tables, with all that a Chart says.
Json charts_data(const std::vector<Observable>& observables);

/// A packing fraction with two decimals if that is exact, else four: 0.50, 0.7125.
std::string density_text(double phi);

/// The one number, or one of several, of a column, with its error as "1.234 ± 0.012"; "–" if the
/// table, the column or the number is not there.
std::string table_text(const Results& results, const std::string& table, const std::string& column,
                       std::size_t row = 0);
/// NaN if it is not there.
double table_value(const Results& results, const std::string& table, const std::string& column,
                   std::size_t row = 0);

}  // namespace vitrel
