#include "app/workflow/report/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/workflow/report/page_parts.h"

namespace vitrel {

namespace {

using nlohmann::json;

constexpr double points_per_decade = 30;
constexpr std::size_t most_energy_samples = 400;

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

json curve(const std::vector<double>& time, const Correlation& square) {
  if (square.value.empty()) return nullptr;
  const std::vector<std::size_t> rows = logarithmic_rows(time);
  return {{"time", page_numbers(time, rows)},
          {"value", page_numbers(square.value, rows)},
          {"error", page_numbers(square.error, rows)}};
}

json energy(const EnergySeries& series) {
  const std::size_t size = series.time.size();
  const std::size_t stride =
      std::max<std::size_t>(1, (size + most_energy_samples - 1) / most_energy_samples);
  const std::vector<std::size_t> rows = every(stride, size);
  return {{"stride", stride},
          {"time", page_numbers(series.time, rows)},
          {"translational", page_numbers(series.translational, rows)},
          {"rotational", page_numbers(series.rotational, rows)},
          {"total", page_numbers(series.total, rows)}};
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

}  // namespace

std::string report_page(const ReportData& data) {
  json runs = json::array();
  std::string rows;
  for (const ReportRun* run : ordered(data.runs)) {
    runs.push_back(run_data(*run, data.runs));
    rows += table_row(*run);
  }
  return whole_page({data.title,
                     data.subtitle,
                     "page/runs_sections.html",
                     "page/report.js",
                     {{"table_rows", rows}},
                     {{"runs", std::move(runs)}},
                     data.parameters,
                     data.provenance});
}

}  // namespace vitrel
