#include "workflow/report/page_tables.h"
#include "core/io/json.h"
#include "core/io/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "workflow/report/page_parts.h"

namespace vitrel {

namespace {

constexpr int error_digits = 3;
constexpr std::array<std::string_view, 3> series = {"energies", "compressibility_factor", "order"};

// What the page makes charts from (report.js).
constexpr std::array<std::string_view, 14> shown = {"summary",
                                                    "cage_relative",
                                                    "velocities",
                                                    "velocity_distribution",
                                                    "wave_numbers",
                                                    "susceptibility",
                                                    "collective_scattering",
                                                    "structure_factor",
                                                    "pair_correlation",
                                                    "order",
                                                    "energies",
                                                    "compressibility_factor",
                                                    "relaxation",
                                                    "glass_fit"};
constexpr std::array<std::string_view, 4> shown_groups = {"displacements_", "self_scattering_",
                                                          "orientation_", "on_the_fly_"};

bool is_correlation(const Table& table) {
  return !table.columns.empty() && table.columns.front().name == "time" &&
         std::find(series.begin(), series.end(), table.name) == series.end();
}

bool is_shown(std::string_view table) {
  return std::find(shown.begin(), shown.end(), table) != shown.end() ||
         std::any_of(shown_groups.begin(), shown_groups.end(),
                     [table](std::string_view prefix) { return table.starts_with(prefix); });
}

/// Rows far enough apart on a logarithmic axis.
std::vector<std::size_t> logarithmic_rows(const std::vector<double>& time, double rows_per_decade) {
  const double growth = std::pow(10, 1 / rows_per_decade) * (1 - 1e-9);
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (rows.empty() || time[k] >= growth * time[rows.back()]) rows.push_back(k);
  return rows;
}

std::vector<std::size_t> every(std::size_t stride, std::size_t size) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < size; k += stride) rows.push_back(k);
  return rows;
}

Json column_data(const Column& column, const std::vector<std::size_t>& rows) {
  Json data = {{"unit", column.unit}, {"value", page_numbers(column.value, rows)}};
  if (!column.error.empty()) data["error"] = page_numbers(column.error, rows, error_digits);
  return data;
}

Json table_data(const Table& table, const Thinning& thinning) {
  const bool logarithmic = is_correlation(table);
  const std::size_t stride = logarithmic || table.rows() == 0
                                 ? 1
                                 : (table.rows() + thinning.max_rows - 1) / thinning.max_rows;
  const std::vector<std::size_t> rows =
      logarithmic ? logarithmic_rows(table.columns.front().value, thinning.rows_per_decade)
                  : every(stride, table.rows());
  Json columns = Json::object();
  for (const Column& column : table.columns) columns[column.name] = column_data(column, rows);
  return {{"stride", stride}, {"columns", std::move(columns)}};
}

const Column* find(const Results& results, const std::string& table, const std::string& column,
                   std::size_t row) {
  const Table* found = results.find(table);
  const Column* values = found ? found->find(column) : nullptr;
  return values && row < values->value.size() ? values : nullptr;
}

}  // namespace

Json tables_data(const Results& results, const Thinning& thinning) {
  Json data = Json::object();
  for (const Table& table : results.tables)
    if (is_shown(table.name)) data[table.name] = table_data(table, thinning);
  return data;
}

std::string density_text(double phi) {
  const bool two_suffice = std::abs(phi * 100 - std::round(phi * 100)) < 1e-6;
  return fmt::format("{:.{}f}", phi, two_suffice ? 2 : 4);
}

std::string table_text(const Results& results, const std::string& table, const std::string& column,
                       std::size_t row) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Column* found = find(results, table, column, row);
  if (!found) return "–";
  return with_error(found->value[row], found->error.empty() ? none : found->error[row]);
}

double table_value(const Results& results, const std::string& table, const std::string& column,
                   std::size_t row) {
  const Column* found = find(results, table, column, row);
  return found ? found->value[row] : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace vitrel
