#include "workflow/report/packing_page.h"

#include <nlohmann/json.hpp>

#include "core/io/json.h"
#include "workflow/report/page_parts.h"
#include "workflow/report/page_tables.h"

namespace vitrel {

std::string packing_page(const PackingPage& page) {
  return whole_page({page.title,
                     page.subtitle,
                     "page/packing_sections.html",
                     "page/packing.js",
                     {{"rows", table_rows(page.rows)}},
                     script_safe(Json{{"label", page.title},
                                      {"movie", movie_data(page.movie)},
                                      {"tables", tables_data(page.results, {})}}),
                     page.parameters,
                     page.provenance,
                     3});
}

}  // namespace vitrel
