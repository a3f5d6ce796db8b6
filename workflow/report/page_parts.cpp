#include "workflow/report/page_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "workflow/report/assets.h"

namespace vitrel {

using nlohmann::json;

json page_number(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  return std::stod(fmt::format("{:.{}g}", value, digits));
}

void add_shapes(json& data, const std::vector<std::vector<double>>& semi_axes) {
  std::map<std::vector<double>, std::size_t> known;
  json shapes = json::array(), shape = json::array();
  for (const std::vector<double>& axes : semi_axes) {
    const auto [place, added] = known.emplace(axes, known.size());
    if (added) {
      json& numbers = shapes.emplace_back(json::array());
      for (const double axis : axes) numbers.push_back(page_number(axis));
    }
    shape.push_back(place->second);
  }
  data["shapes"] = std::move(shapes);
  data["shape"] = std::move(shape);
}

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, "\u202f");
  return digits;
}

std::string with_error(double value, double error) {
  if (!std::isfinite(value)) return "–";
  if (!std::isfinite(error)) return fmt::format("{:.4g}", value);
  if (error == 0) return fmt::format("{:.6g}", value);
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(error))));
  // Rounding 0.0996 to two digits gives 0.10: one decimal less.
  const bool carries = std::round(error * std::pow(10, decimals)) >= 100;
  const int shown = std::max(0, decimals - (carries ? 1 : 0));
  return fmt::format("{:.{}f} ± {:.{}f}", value, shown, error, shown);
}

namespace {

// JSON inside a script element: no "<" may be left that could end it.
std::string script_safe(const json& data) {
  std::string text = data.dump(-1, ' ', false, json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;)
    text.replace(at, 1, "\\u003c");
  return text;
}

// Replaces every {{name}} of the template by its text, in one pass, so that no text is looked into.
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

}  // namespace

std::string whole_page(PageParts parts) {
  const auto text = [](std::string_view path) { return std::string(asset(path)); };
  const std::string stage = text("page/stage.html");
  parts.texts.emplace_back("stage", stage);
  parts.texts.emplace_back("movie", filled(asset("page/movie.html"), {{"stage", stage}}));
  return filled(asset("page/page.html"), {{"title", escaped(parts.title)},
                                          {"subtitle", escaped(parts.subtitle)},
                                          {"uplot_style", text("vendor/uplot/uPlot.min.css")},
                                          {"style", text("page/report.css")},
                                          {"sections", filled(asset(parts.sections), parts.texts)},
                                          {"parameters", escaped(parts.parameters)},
                                          {"unit_of_length", std::string(parts.unit_of_length)},
                                          {"provenance", provenance_entries(parts.provenance)},
                                          {"data", script_safe(parts.data)},
                                          {"uplot_licence", text("vendor/uplot/LICENSE")},
                                          {"uplot", text("vendor/uplot/uPlot.iife.min.js")},
                                          {"common", text("page/common.js")},
                                          {"charts", text("page/charts.js")},
                                          {"picture", text("page/picture.js")},
                                          {"picture_script", text(parts.picture)},
                                          {"script", text(parts.script)}});
}

}  // namespace vitrel
