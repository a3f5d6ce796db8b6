#include "app/workflow/report/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/workflow/report/assets.h"
#include "app/workflow/report/html.h"

namespace vitrel {

namespace {

using nlohmann::json;

constexpr double points_per_decade = 30;
constexpr std::size_t most_energy_samples = 400;
constexpr std::size_t most_pictured_particles = 4000;

/// Six significant digits are more than any pixel shows; JSON has no NaN, null stands for it.
json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::stod(fmt::format("{:.6g}", value));
}

template <class Values, class Index>
json numbers(const Values& values, const Index& rows) {
  json array = json::array();
  for (const std::size_t row : rows) array.push_back(number(values[row]));
  return array;
}

std::vector<std::size_t> every(std::size_t stride, std::size_t size) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < size; k += stride) rows.push_back(k);
  return rows;
}

/// Rows far enough apart on a logarithmic axis.
std::vector<std::size_t> logarithmic_rows(const std::vector<double>& time) {
  const double growth = std::pow(10, 1 / points_per_decade) * (1 - 1e-9);
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (rows.empty() || time[k] >= growth * time[rows.back()]) rows.push_back(k);
  return rows;
}

json curve(const std::vector<double>& time, const MeanSquare& square) {
  if (square.value.empty()) return nullptr;
  const std::vector<std::size_t> rows = logarithmic_rows(time);
  return {{"time", numbers(time, rows)},
          {"value", numbers(square.value, rows)},
          {"error", numbers(square.error, rows)}};
}

json energy(const EnergySeries& series) {
  const std::size_t size = series.time.size();
  const std::size_t stride =
      std::max<std::size_t>(1, (size + most_energy_samples - 1) / most_energy_samples);
  const std::vector<std::size_t> rows = every(stride, size);
  return {{"stride", stride},
          {"time", numbers(series.time, rows)},
          {"translational", numbers(series.translational, rows)},
          {"rotational", numbers(series.rotational, rows)},
          {"total", numbers(series.total, rows)}};
}

/// The part of the box, as a fraction of its sides about the centre, that is pictured.
double pictured_fraction(std::size_t particles) {
  const double share =
      static_cast<double>(most_pictured_particles) / static_cast<double>(particles);
  return std::sqrt(std::min(1.0, share));
}

/// x, y, angle modulo π, a, b of the particles in the window, one after the other. Positions are
/// rounded to a thousandth of the unit of length.
json picture(const Configuration2& state) {
  if (state.size() == 0) return nullptr;
  const double fraction = pictured_fraction(state.size());
  const Vec2 window = fraction * state.box.lengths();
  const double margin = fraction < 1 ? largest_circumradius(state) : 0;
  const auto rounded = [](double value) { return std::round(value * 1000) / 1000; };
  json particles = json::array();
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec2& r = state.position[i];
    if ((r.cwiseAbs() - 0.5 * window).maxCoeff() > margin) continue;
    const double turn = state.angle[i] - M_PI * std::floor(state.angle[i] / M_PI);
    for (const double value : {r.x(), r.y(), turn, state.shape[i].a, state.shape[i].b})
      particles.push_back(rounded(value));
  }
  return {{"time", number(state.time)},
          {"window", {number(window.x()), number(window.y())}},
          {"periodic", fraction == 1},
          {"particles", std::move(particles)}};
}

const DisplacementGroup* all_particles(const ReportRun& run) {
  return run.displacements.groups.empty() ? nullptr : &run.displacements.groups.front();
}

/// The runs by packing fraction.
std::vector<const ReportRun*> ordered(const std::vector<ReportRun>& runs) {
  std::vector<const ReportRun*> order;
  for (const ReportRun& run : runs) order.push_back(&run);
  std::stable_sort(order.begin(), order.end(), [](const ReportRun* left, const ReportRun* right) {
    return left->packing_fraction < right->packing_fraction;
  });
  return order;
}

/// With two decimals if that is exact, else four: 0.50, 0.7125.
std::string density(const ReportRun& run) {
  const double phi = run.packing_fraction;
  const bool two_suffice = std::abs(phi * 100 - std::round(phi * 100)) < 1e-6;
  return fmt::format("{:.{}f}", phi, two_suffice ? 2 : 4);
}

/// 1234567 with thin spaces between groups of three digits.
std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, "\u202f");
  return digits;
}

/// "φ = 0.5", with the name of the run where another one has the same density.
std::string label(const ReportRun& run, const std::vector<ReportRun>& runs) {
  const auto equals = std::count_if(runs.begin(), runs.end(), [&](const ReportRun& other) {
    return density(other) == density(run);
  });
  return "φ = " + density(run) + (equals > 1 ? " (" + run.name + ")" : "");
}

json run_data(const ReportRun& run, const std::vector<ReportRun>& runs) {
  const DisplacementGroup* all = all_particles(run);
  const std::vector<double>& lag = run.displacements.lag;
  return {{"label", label(run, runs)},
          {"dynamics", run.dynamics},
          {"particles", run.particles},
          {"rotors", run.rotors},
          {"msd", all ? curve(lag, all->translation) : json(nullptr)},
          {"msr", all ? curve(lag, all->rotation) : json(nullptr)},
          {"energy", energy(run.energy)},
          {"state", picture(run.final_state)}};
}

/// JSON inside a script element: no "<" may be left that could end it.
std::string script_safe(const json& data) {
  std::string text = data.dump(-1, ' ', false, json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;)
    text.replace(at, 1, "\\u003c");
  return text;
}

std::string cell(const std::string& text) {
  return "<td>" + text + "</td>";
}

std::string diffusion_cell(const ReportRun& run, bool rotation) {
  const DisplacementGroup* all = all_particles(run);
  if (!all) return cell("–");
  const Diffusion d = rotation ? long_time_diffusion(run.displacements.lag, all->rotation, 1)
                               : long_time_diffusion(run.displacements.lag, all->translation, 2);
  return cell(with_error(d.value, d.error));
}

std::string mean_cell(const ReportRun& run, const std::vector<double>& series) {
  if (series.empty()) return cell("–");
  const Estimate mean = time_average(run.energy.time, series);
  return cell(with_error(mean.mean, mean.error));
}

std::string table_row(const ReportRun& run) {
  return "<tr><th scope=\"row\">" + density(run) + "</th>" +
         cell(with_error(run.compressibility.mean, run.compressibility.error)) +
         diffusion_cell(run, false) + diffusion_cell(run, true) +
         mean_cell(run, run.energy.translational) +
         (run.rotors > 0 ? mean_cell(run, run.energy.rotational) : cell("–")) +
         cell(grouped(run.collisions)) + cell(fmt::format("{:.6g}", run.duration)) +
         cell(grouped(run.particles)) + cell(escaped(run.name)) + "</tr>\n";
}

/// Replaces every {{name}} of the template by its text, in one pass, so that no text is looked
/// into.
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

std::string report_page(const ReportData& data) {
  json runs = json::array();
  std::string rows;
  for (const ReportRun* run : ordered(data.runs)) {
    runs.push_back(run_data(*run, data.runs));
    rows += table_row(*run);
  }
  const auto text = [](std::string_view path) { return std::string(asset(path)); };
  return filled(asset("page/page.html"), {{"title", escaped(data.title)},
                                          {"subtitle", escaped(data.subtitle)},
                                          {"uplot_style", text("vendor/uplot/uPlot.min.css")},
                                          {"style", text("page/report.css")},
                                          {"table_rows", rows},
                                          {"parameters", escaped(data.parameters)},
                                          {"provenance", provenance_entries(data.provenance)},
                                          {"data", script_safe({{"runs", std::move(runs)}})},
                                          {"uplot_licence", text("vendor/uplot/LICENSE")},
                                          {"uplot", text("vendor/uplot/uPlot.iife.min.js")},
                                          {"script", text("page/report.js")}});
}

}  // namespace vitrel
