#include "workflow/report/runs_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/number_text.h"
#include "workflow/report/html.h"
#include "workflow/report/page_tables.h"

namespace vitrel {
namespace {

struct Quantity {
  const char* symbol;  ///< as HTML
  const char* column;
  bool is_count = false;
  bool is_of_motion = false;  ///< left out if all runs are states
  bool is_exception = false;  ///< left out if it is 0 in all runs
};

constexpr Quantity quantities[] = {{"Z", "compressibility_factor"},
                                   {"βP/ρ", "reduced_pressure"},
                                   {"τ<sub>α</sub>", "tau_translation"},
                                   {"τ<sub>2</sub>", "tau_rotation"},
                                   {"D", "diffusion"},
                                   {"D<sub>r</sub>", "rotational_diffusion"},
                                   {"η", "viscosity"},
                                   {"E<sub>trans</sub>/N", "translational_energy", false, true},
                                   {"E<sub>rot</sub>/N", "rotational_energy", false, true},
                                   {"S", "nematic_order"},
                                   {"ψ<sub>6</sub>", "hexatic_order"},
                                   {"ρ", "orientation_ratio"},
                                   {"contacts", "contact_number"},
                                   {"early releases", "early_releases_per_collision"},
                                   {"blocked rotations", "blocked_rotations_per_collision"},
                                   {"collisions", "collisions", true},
                                   {"correction moves", "correction_moves", true, false, true},
                                   {"speed", "collisions_per_second_with_output", true},
                                   {"time", "wall_seconds"},
                                   {"duration", "duration", false, true},
                                   {"N", "particles", true}};

bool differs(const Column& column) {
  return std::ranges::any_of(column.value,
                             [&](double value) { return value != column.value.front(); });
}

/// Finds the column; null if no run has a value in it.
const Column* shown(const Table& table, const std::string& name) {
  const Column* column = table.find(name);
  const auto is_known = [](double value) { return std::isfinite(value); };
  return column && std::ranges::any_of(column->value, is_known) ? column : nullptr;
}

bool has_motion(const Table& table) {
  const Column* duration = table.find("duration");
  return duration && std::ranges::any_of(duration->value, [](double time) { return time > 0; });
}

const Column* shown(const Table& table, const Quantity& quantity) {
  const Column* column = shown(table, quantity.column);
  const bool is_left_out =
      (quantity.is_of_motion && !has_motion(table)) ||
      (quantity.is_exception && column &&
       !std::ranges::any_of(column->value, [](double value) { return value > 0; }));
  return is_left_out ? nullptr : column;
}

const Column* shown_seed(const Table& table) {
  const Column* seed = shown(table, "seed");
  return seed && differs(*seed) ? seed : nullptr;
}

std::string key_text(const Column& column, std::size_t row) {
  const double value = column.value[row];
  if (!column.labels.empty()) return escaped(label_of(column, row).value_or(""));
  return column.name == "packing_fraction" ? density_text(value) : fmt::format("{:.6g}", value);
}

std::string value_text(const Table& table, const Quantity& quantity, const Column& column,
                       std::size_t row) {
  const double value = column.value[row];
  const Column* rotations = table.find("rotations");
  const bool cannot_turn = rotations && rotations->value[row] == 0 &&
                           std::string_view(quantity.column) == "rotational_energy";
  if (!std::isfinite(value) || cannot_turn) return "–";
  if (quantity.is_count) return grouped(static_cast<std::uint64_t>(value));
  if (column.error.empty()) return fmt::format("{:.6g}", value);
  return with_error(value, column.error[row]);
}

}  // namespace

std::string runs_heading(const RunsTable& table, const PageUnits& units) {
  std::string symbols, unit_row;
  const auto add = [&](const std::string& symbol, const std::string& unit) {
    symbols += "<th scope=\"col\">" + symbol + "</th>";
    unit_row += table_cell(escaped(unit_name(unit, units)));
  };
  for (std::size_t k = 0; k < table.keys.size(); ++k)
    add(escaped(table.symbols[k]), table.values.find(table.keys[k])->unit);
  if (shown_seed(table.values)) add("seed", "1");
  for (const Quantity& quantity : quantities)
    if (const Column* column = shown(table.values, quantity)) add(quantity.symbol, column->unit);
  add("run", "1");
  return "<tr>" + symbols + "</tr>\n<tr class=\"units\">" + unit_row + "</tr>\n";
}

std::string runs_rows(const RunsTable& table) {
  std::string rows;
  for (std::size_t row = 0; row < table.names.size(); ++row) {
    std::string cells;
    for (std::size_t k = 0; k < table.keys.size(); ++k) {
      const std::string text = key_text(*table.values.find(table.keys[k]), row);
      cells += k == 0 ? "<th scope=\"row\">" + text + "</th>" : table_cell(text);
    }
    if (const Column* seed = shown_seed(table.values))
      cells += table_cell(fmt::format("{:.0f}", seed->value[row]));
    for (const Quantity& quantity : quantities)
      if (const Column* column = shown(table.values, quantity))
        cells += table_cell(value_text(table.values, quantity, *column, row));
    rows += "<tr>" + cells + table_cell(escaped(table.names[row])) + "</tr>\n";
  }
  return rows;
}

}  // namespace vitrel
