#include "workflow/report/packing_page.h"

#include <nlohmann/json.hpp>

#include "analysis/observables/frame_observable.h"
#include "core/io/json.h"
#include "workflow/report/page_parts.h"
#include "workflow/report/page_tables.h"

namespace vitrel {

std::string packing_page(const PackingPage& page) {
  const std::vector<Observable> tables = frame_observables<3>();
  return whole_page({page.title,
                     page.subtitle,
                     "page/packing_sections.html",
                     "page/packing.js",
                     {{"rows", table_rows(page.rows)}},
                     script_safe(Json{{"label", page.title},
                                      {"movie", movie_data(page.movie)},
                                      {"charts", charts_data(tables)},
                                      {"tables", tables_data(page.results, tables)}}),
                     page.parameters,
                     page.provenance,
                     3,
                     page.units});
}

}  // namespace vitrel
