#include "workflow/report/state_page.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "analysis/observables/frame_observable.h"
#include "core/io/json.h"
#include "workflow/report/page_parts.h"
#include "workflow/report/page_tables.h"

namespace vitrel {

namespace {

/// The points of a curve; null if there are no values.
Json curve(const std::vector<double>& abscissa, const std::vector<double>& value) {
  if (value.empty()) return nullptr;
  std::vector<std::size_t> rows(value.size());
  std::iota(rows.begin(), rows.end(), 0);
  return {{"time", page_numbers(abscissa, rows)}, {"value", page_numbers(value, rows)}};
}

/// The correlation in the bins that contain pairs; null if there are none.
Json correlation(const NematicCorrelation& correlation) {
  std::vector<std::size_t> rows;
  std::vector<double> error;
  for (std::size_t k = 0; k < correlation.pairs.size(); ++k) {
    error.push_back(1 / std::sqrt(2 * static_cast<double>(correlation.pairs[k])));
    if (correlation.pairs[k] > 0) rows.push_back(k);
  }
  if (rows.empty()) return nullptr;
  return {{"time", page_numbers(correlation.distance, rows)},
          {"value", page_numbers(correlation.value, rows)},
          {"error", page_numbers(error, rows)}};
}

}  // namespace

std::string state_page(const StatePage& page) {
  const bool in_plane = std::holds_alternative<Movie2>(page.movie);
  const std::vector<Observable> tables = frame_observables(in_plane ? 2 : 3);
  const Json data = {{"label", page.title},
                     {"movie", movie_data(page.movie)},
                     {"charts", charts_data(tables)},
                     {"tables", tables_data(page.structure, tables)},
                     {"correlation", correlation(page.nematic_correlation)},
                     {"order", page_number(page.nematic_order)},
                     {"orientation", curve(page.sweeps, page.orientation)},
                     {"displacement", curve(page.sweeps, page.displacement)}};
  return whole_page({page.title,
                     page.subtitle,
                     in_plane ? "page/state_sections.html" : "page/packing_sections.html",
                     "page/state.js",
                     {{"rows", table_rows(page.rows)}},
                     script_safe(data),
                     page.parameters,
                     page.provenance,
                     in_plane ? 2 : 3,
                     page.units});
}

}  // namespace vitrel
