#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/results.h"

/// Tables of results, as the pages carry and show them.
namespace vitrel {

/// For the script: a table by its name; in it the columns by theirs, with unit, value and error (if
/// there is any), and the stride that evenly spaced rows were thinned by.
///
/// Correlations, whose first column is the time, keep 20 rows a decade; the series energies,
/// compressibility and order, and tables of any other kind, 400 rows evenly.
nlohmann::json tables_data(const Results& results);

/// The one number, or one of several, of a column, with its error as "1.234 ± 0.012"; "–" if the
/// table, the column or the number is not there.
std::string table_text(const Results& results, const std::string& table, const std::string& column,
                       std::size_t row = 0);
/// NaN if it is not there.
double table_value(const Results& results, const std::string& table, const std::string& column,
                   std::size_t row = 0);

}  // namespace vitrel
