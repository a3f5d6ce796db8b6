#include "workflow/report/page_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/io/json.h"
#include "workflow/report/assets.h"

namespace vitrel {

Json page_number(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  return std::stod(fmt::format("{:.{}g}", value, digits));
}

Json page_numbers(const std::vector<double>& values, const std::vector<std::size_t>& rows,
                  int digits) {
  Json array = Json::array();
  for (const std::size_t row : rows) array.push_back(page_number(values[row], digits));
  return array;
}

void add_shapes(Json& data, const std::vector<std::vector<double>>& semi_axes) {
  std::map<std::vector<double>, std::size_t> known;
  Json shapes = Json::array(), shape = Json::array();
  for (const std::vector<double>& axes : semi_axes) {
    const auto [place, added] = known.emplace(axes, known.size());
    if (added) {
      Json& numbers = shapes.emplace_back(Json::array());
      for (const double axis : axes) numbers.push_back(page_number(axis));
    }
    shape.push_back(place->second);
  }
  data["shapes"] = std::move(shapes);
  data["shape"] = std::move(shape);
}

std::string script_safe(const Json& data) {
  std::string text = json_text(data);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;)
    text.replace(at, 1, "\\u003c");
  return text;
}

std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string>>& texts) {
  std::string result;
  while (!page.empty()) {
    const std::size_t open = page.find("{{");
    result += page.substr(0, open);
    if (open == std::string_view::npos) break;
    const std::size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    for (const auto& [key, text] : texts)
      if (key == name) result += text;
    page.remove_prefix(close + 2);
  }
  return result;
}

const PageUnits& page_units(int dimension) {
  constexpr static PageUnits plane{"a b", "√(ab)", "ab"}, space{"a b c", "∛(abc)", "(abc)^⅔"};
  return dimension == 2 ? plane : space;
}

std::string whole_page(PageParts parts) {
  const auto text = [](std::string_view path) { return std::string(asset(path)); };
  const bool in_plane = parts.dimension == 2;
  const PageUnits& units = page_units(parts.dimension);
  const std::string length(units.length), area(units.area);
  parts.texts.emplace_back("unit_of_length", length);
  parts.texts.emplace_back("unit_of_area", area);
  parts.texts.emplace_back("movie", filled(asset("page/movie.html"),
                                           {{"slice", in_plane ? "" : text("page/slice.html")},
                                            {"solids", in_plane ? "" : text("page/solids.html")}}));
  return filled(asset("page/page.html"),
                {{"title", escaped(parts.title)},
                 {"subtitle", escaped(parts.subtitle)},
                 {"uplot_style", text("vendor/uplot/uPlot.min.css")},
                 {"style", text("page/report.css")},
                 {"sections", filled(asset(parts.sections), parts.texts)},
                 {"parameters", escaped(parts.parameters)},
                 {"unit_product", std::string(units.product)},
                 {"unit_of_length", length},
                 {"unit_of_area", area},
                 {"dimension", std::to_string(parts.dimension)},
                 {"provenance", provenance_entries(parts.provenance)},
                 {"data", parts.data},
                 {"uplot_licence", text("vendor/uplot/LICENSE")},
                 {"uplot", text("vendor/uplot/uPlot.iife.min.js")},
                 {"common", text("page/common.js")},
                 {"charts", text("page/charts.js")},
                 {"picture", text("page/picture.js")},
                 {"player", text("page/player.js")},
                 {"picture_script", text(in_plane ? "page/movie.js" : "page/solids.js")},
                 {"script", text(parts.script)}});
}

}  // namespace vitrel
