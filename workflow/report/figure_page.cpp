#include "workflow/report/figure_page.h"

#include <nlohmann/json.hpp>

#include "core/io/json.h"
#include "core/io/text_file.h"
#include "workflow/report/page_parts.h"
#include "workflow/report/page_tables.h"

namespace vitrel {
namespace {

Json figure_data(const Figure& of) {
  constexpr const char* kinds[] = {"curves", "paths", "map"};
  Json data = {{"kind", kinds[static_cast<int>(of.kind)]},
               {"heading", of.heading},
               {"xSymbol", of.x_symbol},
               {"symbol", of.y_symbol},
               {"showsZero", of.shows_zero},
               {"value", of.value},
               {"firstRow", of.first_row},
               {"side", of.side},
               {"isLogarithmic", of.has_logarithmic_y}};
  for (const auto& [x, y, label] : of.curves)
    data["curves"].push_back({{"x", x}, {"y", y}, {"label", label}});
  if (of.mark) data["mark"] = {{"value", of.mark->first}, {"label", of.mark->second}};
  data["outlines"] = Json::array();
  for (const auto& [x, y, radius] : of.outlines)
    data["outlines"].push_back({{"x", x}, {"y", y}, {"radius", radius}});
  return data;
}

std::string figure_page(const FigurePage& page) {
  const Table& table = page.results.tables.front();
  Json figures = Json::array();
  for (const Figure& figure : page.figures) figures.push_back(figure_data(figure));
  const bool has_maps = page.figures.front().kind == Figure::Kind::map;
  return whole_page({.title = page.title,
                     .subtitle = "",
                     .sections = "page/figure_sections.html",
                     .script = "page/figure.js",
                     .texts = {{"description", escaped(table.description)},
                               {"layout", has_maps ? "charts maps" : "charts"}},
                     .data = script_safe(Json{{"file", table.name + ".csv"},
                                              {"figures", std::move(figures)},
                                              {"table", table_data(table)}}),
                     .parameters = page.parameters,
                     .provenance = page.results.provenance,
                     .units = FileUnits{},
                     .units_note = page.units});
}

}  // namespace

Table table_of_rows(const std::string& name, const std::string& description,
                    const std::vector<std::pair<std::string, std::string>>& columns,
                    const std::vector<std::vector<double>>& rows) {
  Table table{name, description, {}};
  for (const auto& [column, unit] : columns) {
    const std::size_t c = table.columns.size();
    table.columns.push_back({column, unit, {}, {}});
    for (const std::vector<double>& row : rows) table.columns[c].value.push_back(row[c]);
  }
  return table;
}

void write_figures(const std::filesystem::path& path, const FigurePage& page) {
  if (path.extension() == ".csv") return write_csv(path, page.results.tables.front());
  if (path.extension() == ".html") return write_text(path, figure_page(page));
  Results results = page.results;
  results.provenance.emplace_back("parameters", page.parameters);
  write_results(path, results);
}

}  // namespace vitrel
