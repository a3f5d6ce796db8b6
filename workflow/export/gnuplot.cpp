#include "workflow/export/gnuplot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string_view>

#include "workflow/export/frame_sink.h"
#include "workflow/export/pending_folder.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

template <std::size_t n>
bool contains(const std::array<std::string_view, n>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr std::array<std::string_view, 6> axis_columns = {"time",  "q",         "r",
                                                          "angle", "frequency", "packing_fraction"};
/// Counts and codes.
constexpr std::array<std::string_view, 14> not_drawn = {"origins",
                                                        "modes",
                                                        "particles",
                                                        "duration",
                                                        "seed",
                                                        "rotors",
                                                        "frames",
                                                        "collisions",
                                                        "verdict",
                                                        "tests",
                                                        "verdict_translation",
                                                        "tests_translation",
                                                        "orientation",
                                                        "wave_number"};
constexpr std::array<std::string_view, 7> logarithmic_units = {
    "length^2", "length^4", "rad^2", "rad^4", "time", "length^2/time", "rad^2/time"};
/// Beginnings of the names of tables over time differences.
constexpr std::array<std::string_view, 9> correlations = {
    "displacements_", "self_scattering_",      "orientation_",
    "susceptibility", "cage_relative",         "ageing",
    "on_the_fly_",    "collective_scattering", "velocity_autocorrelation"};

bool is_over_time_differences(const Table& table) {
  return table.columns.front().name == "time" &&
         std::any_of(correlations.begin(), correlations.end(),
                     [&](std::string_view start) { return table.name.starts_with(start); });
}

/// What is drawn of a table along one direction.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    if (std::isnan(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool is_empty() const { return low > high; }
  bool is_point() const { return low == high; }
};

struct Curve {
  const Column* column;
  std::size_t place;  ///< in the lines of the data file, from 1; an error follows
};

struct Panel {
  std::string unit;
  bool logarithmic = false;
  std::vector<Curve> curves;
  Extent x, y;
};

class Script {
 public:
  Script(const Table& table, const Results& results)
      : table_(table),
        results_(results),
        x_(table.columns.front()),
        logarithmic_x_(is_over_time_differences(table)) {
    const bool increases = std::adjacent_find(x_.value.begin(), x_.value.end(),
                                              std::greater_equal<>()) == x_.value.end();
    style_ = !increases            ? "points pt 7 ps 0.5"
             : table.rows() <= 100 ? "linespoints pt 7 ps 0.4"
                                   : "lines";
    if (contains(axis_columns, x_.name)) collect_panels();
  }

  bool is_empty() const { return panels_.empty(); }

  std::string text() const {
    const std::size_t columns = std::min<std::size_t>(panels_.size(), 2);
    const std::size_t rows = (panels_.size() + columns - 1) / columns;
    std::string text = fmt::format(
        "# gnuplot {0}.gp draws {0}.svg; other formats: help terminal.\n"
        "set terminal svg size {1},{2} background \"white\"\n"
        "set output \"{0}.svg\"\n"
        "set multiplot layout {3},{4} title \"{0}\" noenhanced\n"
        "set key above left horizontal noenhanced\n"
        "# Error bars short and without a blank around their middle.\n"
        "set errorbars 0.3\n"
        "set pointintervalbox 0.01\n"
        "set grid\n"
        "set xlabel \"{5}\"\n",
        table_.name, 660 * columns, 400 * rows + 40, rows, columns, axis_label());
    if (style_.starts_with("points"))
      text += "set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\n";
    if (logarithmic_x_) text += "set logscale x\nset format x \"10^{%L}\"\n";
    for (const Panel& panel : panels_) text += panel_text(panel);
    return text + "unset multiplot\n";
  }

 private:
  std::string axis_label() const {
    return x_.name == x_.unit || x_.unit == "1" ? spaced(x_.name)
                                                : fmt::format("{} [{}]", spaced(x_.name), x_.unit);
  }

  static std::string spaced(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
  }

  void collect_panels() {
    std::size_t place = 0;
    for (const Column& column : table_.columns) {
      ++place;
      if (&column != &x_ && !contains(not_drawn, column.name)) add({&column, place});
      if (!column.error.empty()) ++place;
    }
    std::erase_if(panels_,
                  [](const Panel& panel) { return panel.x.is_empty() || panel.x.is_point(); });
  }

  void add(const Curve& curve) {
    const std::string& unit = curve.column->unit;
    const auto found = std::find_if(panels_.begin(), panels_.end(),
                                    [&](const Panel& panel) { return panel.unit == unit; });
    const bool is_new = found == panels_.end();
    if (is_new) panels_.push_back({unit, contains(logarithmic_units, unit), {}, {}, {}});
    Panel& panel = is_new ? panels_.back() : *found;
    if (extend(panel, *curve.column)) panel.curves.push_back(curve);
  }

  /// Whether anything of the column can be drawn.
  bool extend(Panel& panel, const Column& column) const {
    bool is_drawn = false;
    for (std::size_t k = 0; k < column.value.size(); ++k) {
      const double x = x_.value[k], y = column.value[k];
      const bool can_be_drawn = std::isfinite(x) && std::isfinite(y) &&
                                (!logarithmic_x_ || x > 0) && (!panel.logarithmic || y > 0);
      if (!can_be_drawn) continue;
      is_drawn = true;
      panel.x.add(x);
      panel.y.add(y);
    }
    return is_drawn;
  }

  std::string panel_text(const Panel& panel) const {
    std::string text;
    text += panel.logarithmic ? "set logscale y\nset format y \"10^{%L}\"\n"
                              : "unset logscale y\nset format y \"%h\"\n";
    text += y_range(panel);
    text += fmt::format("set ylabel \"{}\"\n", panel.unit == "1" ? "" : panel.unit);
    text += "plot";
    for (std::size_t k = 0; k < panel.curves.size(); ++k)
      text += fmt::format("{} \\\n  {}", k > 0 ? "," : "", curve_text(panel.curves[k], k + 1));
    return text + '\n';
  }

  /// gnuplot finds a range itself unless all values are equal.
  static std::string y_range(const Panel& panel) {
    if (!panel.y.is_point()) return "set yrange [*:*]\n";
    const double value = panel.y.low;
    if (panel.logarithmic) return fmt::format("set yrange [{}:{}]\n", value / 10, value * 10);
    const double margin = value == 0 ? 1 : std::abs(value) / 2;
    return fmt::format("set yrange [{}:{}]\n", value - margin, value + margin);
  }

  std::string curve_text(const Curve& curve, std::size_t color) const {
    const Column& column = *curve.column;
    std::string text = fmt::format("\"{}.dat\" using 1:{} with {} lc {} title \"{}\"", table_.name,
                                   curve.place, style_, color, title(column.name));
    const bool has_error = std::any_of(column.error.begin(), column.error.end(),
                                       [](double error) { return std::isfinite(error); });
    if (has_error)
      text += fmt::format(", \\\n  \"\" using 1:{}:{} with yerrorbars lc {} pt 0 notitle",
                          curve.place, curve.place + 1, color);
    return text;
  }

  /// Scattering functions are numbered; their wave numbers are in a table of their own.
  std::string title(const std::string& name) const {
    const Table* numbers = results_.find("wave_numbers");
    if (numbers == nullptr || table_.name.find("_scattering") == std::string::npos) return name;
    const Column *index = numbers->find("index"), *q = numbers->find("q");
    if (index == nullptr || q == nullptr) return name;
    for (std::size_t k = 0; k < numbers->rows(); ++k)
      if (name.ends_with(fmt::format("_{}", index->value[k])))
        return fmt::format("{} (q = {:.4g})", name, q->value[k]);
    return name;
  }

  const Table& table_;
  const Results& results_;
  const Column& x_;
  bool logarithmic_x_;
  std::string style_;
  std::vector<Panel> panels_;
};

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string number(double value) {
  return std::isnan(value) ? "nan" : fmt::format("{}", value);
}

std::string data_text(const Table& table, const Results& results) {
  std::string text = fmt::format("# {}\n", one_line(table.description));
  for (const auto& [name, value] : results.provenance)
    text += fmt::format("# {}: {}\n", name, one_line(value));
  std::size_t place = 0;
  for (const Column& column : table.columns) {
    text += fmt::format("# column {}: {} [{}]\n", ++place, column.name, column.unit);
    if (!column.error.empty())
      text += fmt::format("# column {}: {}_error [{}]\n", ++place, column.name, column.unit);
  }
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> numbers;
    for (const Column& column : table.columns) {
      numbers.push_back(number(column.value[row]));
      if (!column.error.empty()) numbers.push_back(number(column.error[row]));
    }
    text += fmt::format("{}\n", fmt::join(numbers, " "));
  }
  return text;
}

}  // namespace

std::vector<TextFile> gnuplot_files(const Results& results) {
  std::vector<TextFile> files;
  for (const Table& table : results.tables) {
    if (table.columns.empty()) continue;
    files.push_back({table.name + ".dat", data_text(table, results)});
    const Script script(table, results);
    if (!script.is_empty()) files.push_back({table.name + ".gp", script.text()});
  }
  return files;
}

void write_folder(const fs::path& folder, const std::vector<TextFile>& files) {
  PendingFolder pending(folder);
  for (const TextFile& file : files) {
    OutputFile output(pending.partial() / file.name);
    output.write(file.text);
    output.close();
  }
  pending.commit();
}

}  // namespace vitrel
