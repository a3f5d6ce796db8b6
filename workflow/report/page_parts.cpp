#include "workflow/report/page_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/io/json.h"
#include "workflow/report/assets.h"

namespace vitrel {

Json page_number(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  const double rounded = std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
  // Rounding may overflow near the largest number.
  return std::isfinite(rounded) ? Json(rounded) : Json(value);
}

Json page_numbers(const std::vector<double>& values, const std::vector<std::size_t>& rows,
                  int digits) {
  Json array = Json::array();
  for (const std::size_t row : rows) array.push_back(page_number(values[row], digits));
  return array;
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

namespace {

/// The names of units on the page by the units of columns.
Json unit_names(const PageUnits& units) {
  return {{"1", ""},
          {"length", units.length},
          {"length^2", units.area},
          {"1/length", "1/" + units.length},
          {"time", units.time},
          {"rad^2", "rad²"},
          {"length^2/time", units.diffusion},
          {"kT time/length^2", "√(m kT/(ab))"},
          {"kT time/length^3", "√(m kT)/(abc)^⅔"},
          {"kT time^2/length^2", "m"},
          {"kT time^2/length^3", "m/∛(abc)"},
          {"rad^2/time", units.rotational_diffusion}};
}

}  // namespace

PageUnits page_units(int dimension, const std::optional<FileUnits>& of_file) {
  if (of_file) {
    const auto& [length, time] = *of_file;
    return {"Units are those of the file.", length,         length + "²", time,
            length + "²/" + time,           "rad²/" + time, "energy"};
  }
  const bool in_plane = dimension == 2;
  const std::string area = in_plane ? "ab" : "(abc)^⅔";
  return {
      fmt::format("Reduced units: kT = 1, mass of the reference species m = 1, semi-axes of the "
                  "reference species {} = 1.",
                  in_plane ? "a b" : "a b c"),
      in_plane ? "√(ab)" : "∛(abc)",
      area,
      fmt::format("√(m {}/kT)", area),
      fmt::format("√({} kT/m)", area),
      fmt::format("√(kT/(m {}))", area),
      "kT"};
}

std::string unit_name(const std::string& unit, const PageUnits& units) {
  const Json names = unit_names(units);
  return names.contains(unit) ? names[unit].get<std::string>() : unit;
}

std::string whole_page(PageParts parts) {
  const auto text = [](std::string_view path) { return std::string(asset(path)); };
  const bool in_plane = parts.dimension == 2;
  const PageUnits units = page_units(parts.dimension, parts.units);
  const std::pair<std::string_view, std::string> names[] = {
      {"units", units.note},
      {"unit_of_length", escaped(units.length)},
      {"unit_of_area", escaped(units.area)},
      {"unit_of_time", escaped(units.time)},
      {"unit_of_diffusion", escaped(units.diffusion)},
      {"unit_of_rotational_diffusion", escaped(units.rotational_diffusion)},
      {"unit_of_energy", units.energy}};
  parts.texts.insert(parts.texts.end(), std::begin(names), std::end(names));
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
                 {"units", parts.units_note.empty() ? units.note : parts.units_note},
                 {"unit_names", script_safe(unit_names(units))},
                 {"dimension", std::to_string(parts.dimension)},
                 {"provenance", provenance_entries(parts.provenance)},
                 {"data", parts.data},
                 {"uplot_licence", text("vendor/uplot/LICENSE")},
                 {"uplot", text("vendor/uplot/uPlot.iife.min.js")},
                 {"common", text("page/common.js")},
                 {"vector", text("page/vector.js")},
                 {"axes", text("page/axes.js")},
                 {"charts", text("page/charts.js")},
                 {"tables", text("page/tables.js")},
                 {"picture", text("page/picture.js")},
                 {"player", text("page/player.js")},
                 {"picture_script", text(in_plane ? "page/movie.js" : "page/solids.js")},
                 {"script", text(parts.script)}});
}

}  // namespace vitrel
