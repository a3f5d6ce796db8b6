#include "bench/pages/page.h"

#include <nlohmann/json.hpp>

#include "bench/pages/assets.h"
#include "core/io/json.h"
#include "workflow/report/assets.h"
#include "workflow/report/page_parts.h"

namespace vitrel::bench {

std::string page(const std::string& title, const std::string& subtitle, const Json& data) {
  PageProvenance provenance;
  for (const auto& [name, text] : data.at("provenance").items())
    provenance.emplace_back(name, text);
  const auto shared = [](std::string_view path) { return std::string(vitrel::asset(path)); };
  return filled(asset("pages/page.html"), {{"title", escaped(title)},
                                           {"subtitle", escaped(subtitle)},
                                           {"uplot_style", shared("vendor/uplot/uPlot.min.css")},
                                           {"style", shared("page/report.css")},
                                           {"bench_style", std::string(asset("pages/bench.css"))},
                                           {"provenance", provenance_entries(provenance)},
                                           {"data", script_safe(data)},
                                           {"uplot_licence", shared("vendor/uplot/LICENSE")},
                                           {"uplot", shared("vendor/uplot/uPlot.iife.min.js")},
                                           {"common", shared("page/common.js")},
                                           {"vector", shared("page/vector.js")},
                                           {"charts", shared("page/charts.js")},
                                           {"script", std::string(asset("pages/bench.js"))}});
}

}  // namespace vitrel::bench
