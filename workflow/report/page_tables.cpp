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

#include "core/special_values.h"
#include "workflow/report/page_parts.h"

namespace vitrel {

namespace {

constexpr int error_digits = 3;
// Tables that pages need although the observables of a run give them no charts: charts need the numbers of the run,
// wave numbers or lags, and tables of a study are no observables of a single run.
constexpr std::array<std::string_view, 7> without_charts = {
    "summary",   "wave_numbers", "lag_times",          "relaxation",
    "glass_fit", "published",    "published_exponents"};
constexpr std::string_view on_the_fly = "on_the_fly";

bool is_shown(std::string_view table, const Observable* observable) {
  return std::ranges::find(without_charts, table) != without_charts.end() ||
         (observable && (observable->table == on_the_fly || !observable->charts.empty()));
}

bool has_logarithmic_rows(const Observable* observable) {
  return observable && (observable->table == on_the_fly ||
                        std::ranges::any_of(observable->charts, [](const Chart& chart) {
                          return chart.is_x_logarithmic;
                        }));
}

/// Selects rows that are far enough apart on a logarithmic axis.
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

/// The meanings of the codes in the given rows.
Json page_labels(const Column& column, const std::vector<std::size_t>& rows) {
  Json labels = Json::array();
  for (const std::size_t row : rows) {
    const std::string text = label_of(column, row).value_or("");
    labels.push_back(text.empty() ? Json() : Json(text));
  }
  return labels;
}

Json column_data(const Column& column, const std::vector<std::size_t>& rows) {
  Json data = {{"unit", column.unit},
               {"value", column.labels.empty() ? page_numbers(column.value, rows)
                                               : page_labels(column, rows)}};
  if (std::ranges::any_of(column.error, [](double error) { return std::isfinite(error); }))
    data["error"] = page_numbers(column.error, rows, error_digits);
  return data;
}

Json table_data(const Table& table, bool logarithmic, const Thinning& thinning) {
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

Json curves_data(const std::vector<Curve>& curves) {
  Json data = Json::array();
  for (const Curve& curve : curves)
    data.push_back(
        {{"column", curve.column}, {"label", curve.label}, {"ofRotors", curve.is_of_rotors}});
  return data;
}

Json numbers_data(const Chart::Numbers& numbers) {
  if (numbers.table.empty()) return nullptr;
  return {{"table", numbers.table}, {"column", numbers.column}, {"symbol", numbers.symbol}};
}

Json chart_data(const Observable& observable, const Chart& chart) {
  constexpr const char* sections[] = {"motion", "relaxation", "structure", "course", "study"};
  constexpr const char* scales[] = {"linear", "logarithmic", "fromZero", "decay", "aroundOne"};
  constexpr const char* levels[] = {"none", "equipartition", "mean"};
  return {{"table", observable.table},
          {"section", sections[static_cast<int>(chart.section)]},
          {"heading", chart.heading},
          {"symbol", chart.symbol},
          {"curves", curves_data(chart.curves)},
          {"references", curves_data(chart.references)},
          {"hasGroups", observable.has_groups},
          {"scale", scales[static_cast<int>(chart.scale)]},
          {"x", chart.x},
          {"xSymbol", chart.x_symbol},
          {"logX", chart.is_x_logarithmic},
          {"levels", chart.levels},
          {"levelOfRun", levels[static_cast<int>(chart.level_of_run)]},
          {"numbers", numbers_data(chart.numbers)},
          {"hasPowerLaws", chart.has_power_laws},
          {"isAngleOfAxis", chart.is_angle_of_axis},
          {"ifMissing", chart.if_missing}};
}

const Column* column_of(const Results& results, const std::string& table, const std::string& column,
                        std::size_t row) {
  const Table* found = results.find(table);
  const Column* values = found ? found->find(column) : nullptr;
  return values && row < values->value.size() ? values : nullptr;
}

}  // namespace

Json tables_data(const Results& results, const std::vector<Observable>& observables,
                 const Thinning& thinning) {
  Json data = Json::object();
  for (const Table& table : results.tables) {
    const Observable* observable = find(observables, table.name);
    if (is_shown(table.name, observable))
      data[table.name] = table_data(table, has_logarithmic_rows(observable), thinning);
  }
  return data;
}

Json table_data(const Table& table) {
  return table_data(table, false, {.max_rows = table.rows()});
}

Json charts_data(const std::vector<Observable>& observables) {
  Json data = Json::array();
  for (const Observable& observable : observables)
    for (const Chart& chart : observable.charts) data.push_back(chart_data(observable, chart));
  return data;
}

std::string density_text(double phi) {
  const bool two_suffice = std::abs(phi * 100 - std::round(phi * 100)) < 1e-6;
  return fmt::format("{:.{}f}", phi, two_suffice ? 2 : 4);
}

std::string table_text(const Results& results, const std::string& table, const std::string& column,
                       std::size_t row) {
  const Column* found = column_of(results, table, column, row);
  if (!found) return "–";
  return with_error(found->value[row], found->error.empty() ? unknown : found->error[row]);
}

double table_value(const Results& results, const std::string& table, const std::string& column,
                   std::size_t row) {
  const Column* found = column_of(results, table, column, row);
  return found ? found->value[row] : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace vitrel
