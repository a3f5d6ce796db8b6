#include "bench/studies/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

namespace vitrel::bench {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double number_at(const Json& row, const std::string& key) {
  const auto found = row.find(key);
  return found == row.end() || !found->is_number() ? none : found->get<double>();
}

std::string text_at(const Json& row, const Column& column) {
  const auto found = row.find(column.key);
  if (found == row.end() || found->is_null()) return "–";
  if (found->is_string()) return found->get<std::string>();
  if (found->is_boolean()) return found->get<bool>() ? "yes" : "·";
  if (found->is_number_integer() && column.shown == Shown::number) return found->dump();
  const double value = found->get<double>();
  switch (column.shown) {
    case Shown::count:
      return value == 0 ? "·" : fmt::format("{:.0f}", value);
    case Shown::all_digits:
      return fmt::format("{:.14g}", value);
    case Shown::time:
      return time_text(value);
    case Shown::error:
      return error_text(value);
    case Shown::share:
      return share_text(value);
    case Shown::text:
    case Shown::number:
      break;
  }
  return std::isnan(value) ? "–" : ratio_text(value);
}

std::string name_of(const Column& column) {
  return column.name.empty() ? column.key : column.name;
}

std::string heading_of(const Column& column) {
  return name_of(column) + (column.unit.empty() ? "" : " (" + column.unit + ")");
}

/// The name of the case of a row, such as "generic, κ = 2".
std::string case_name(const Part& part, const Json& row) {
  std::string name;
  for (const Column& column : part.cases) {
    const auto found = row.find(column.key);
    if (found == row.end() || found->is_null()) continue;
    name += (name.empty() ? "" : ", ") + (found->is_string() ? "" : name_of(column) + " = ") +
            text_at(row, column);
  }
  return name;
}

/// Methods can be compared row by row unless they gain accuracy by what is varied.
bool is_comparable(const Part& part) {
  return part.varied.empty() || part.error.key.empty();
}

/// The name by which rows are compared, such as "generic, κ = 2, particles = 100".
std::string compared_name(const Part& part, const Json& row) {
  const std::string name = case_name(part, row);
  if (part.varied.empty()) return name;
  return fmt::format("{}{}{} = {}", name, name.empty() ? "" : ", ", part.varied,
                     text_at(row, {part.varied}));
}

std::string method_of(const Json& row) {
  return row.value("method", "");
}
std::string curve_of(const Json& row) {
  return row.value("curve", method_of(row));
}

/// The distinct names, in the order of the rows.
template <class Name>
std::vector<std::string> distinct(const Json& rows, Name&& name) {
  std::vector<std::string> all;
  for (const Json& row : rows)
    if (const std::string one = name(row); !std::ranges::count(all, one)) all.push_back(one);
  return all;
}

std::vector<std::string> cases_of(const Part& part, const Json& rows) {
  return distinct(rows, [&](const Json& row) { return case_name(part, row); });
}
std::vector<std::string> methods_of(const Json& rows) {
  return distinct(rows, method_of);
}

double wrong(const Part& part, const Json& row) {
  double sum = 0;
  for (const Column& kind : part.verdicts) sum += number_at(row, kind.key);
  return sum;
}

/// Whether the method answers any pair of the class; if not, it is not made for such pairs.
bool applies(const Json& row) {
  return !(number_at(row, "not_converged") >= number_at(row, "pairs"));
}

/// A table of cases against methods. make_cell receives the row, and the row of the first method in the same case.
template <class MakeCell>
StudyTable matrix(const Part& part, const Json& rows, Content content, const std::string& heading,
                  MakeCell&& make_cell) {
  const std::vector<std::string> methods = methods_of(rows);
  StudyTable table{content, heading, methods, {}};
  table.head.insert(table.head.begin(), "");
  for (const std::string& of :
       distinct(rows, [&](const Json& row) { return compared_name(part, row); })) {
    std::vector<Cell> line = {{of}};
    const Json* first = nullptr;
    for (const std::string& method : methods) {
      const auto row = std::ranges::find_if(rows, [&](const Json& one) {
        return compared_name(part, one) == of && method_of(one) == method;
      });
      const bool known = row != rows.end() && applies(*row);
      if (known && method == methods.front()) first = &*row;
      line.push_back(known ? make_cell(*row, first) : Cell{"–"});
    }
    table.rows.push_back(line);
  }
  return table;
}

Cell failure_cell(const Part& part, const Json& row) {
  const double pairs = number_at(row, "pairs"), share = wrong(part, row) / pairs;
  std::string note = fmt::format("of {}:", pairs);
  for (const Column& kind : part.verdicts)
    note += fmt::format(" {} {},", number_at(row, kind.key), name_of(kind));
  note.pop_back();
  return {share_text(share), note, share};
}

Cell cost_cell(const Part& part, const Json& row, const Json* first) {
  const std::string text = text_at(row, part.cost);
  if (!first || first == &row) return {text};
  const double times = number_at(row, part.cost.key) / number_at(*first, part.cost.key);
  return std::isnan(times) ? Cell{text} : Cell{ratio_text(times), text};
}

StudyTable all_rows(const Part& part, const Json& rows) {
  StudyTable table{Content::all_numbers, "All numbers", {}, {}};
  std::vector<Column> columns;
  const auto add = [&](const Column& column) {
    const auto known = [&](const Json& row) { return row.contains(column.key); };
    if (!column.key.empty() && std::ranges::any_of(rows, known)) columns.push_back(column);
  };
  add({"method"});
  if (!part.varied.empty()) add({part.varied});
  if (!part.verdicts.empty()) add({"pairs"});
  add(part.cost);
  add(part.error);
  for (Column kind : part.verdicts) {
    kind.shown = Shown::count;
    add(kind);
  }
  for (const Column& column : part.others) add(column);
  table.head = {"case"};
  for (const Column& column : columns) table.head.push_back(heading_of(column));
  for (const Json& row : rows) {
    std::vector<Cell> line = {{case_name(part, row)}};
    for (const Column& column : columns) line.push_back({text_at(row, column)});
    table.rows.push_back(line);
  }
  return table;
}

// ---- charts -----------------------------------------------------------------------------------------

struct Point {
  double x, y;
  bool hollow;
  std::string note;
};

Point point_of(const Part& part, const Json& row) {
  const bool has_error = !part.error.key.empty();
  const double cost = number_at(row, part.cost.key);
  Point point{
      has_error ? cost : number_at(row, part.varied),
      has_error ? number_at(row, part.error.key) : cost, wrong(part, row) > 0,
      has_error && !part.varied.empty() ? part.varied + " " + text_at(row, {part.varied}) : ""};
  if (has_error) point.y = std::max(point.y, part.smallest_error);
  if (!part.verdicts.empty())
    point.note += fmt::format("{}{:.0f} of {:.0f} wrong", point.note.empty() ? "" : ", ",
                              wrong(part, row), number_at(row, "pairs"));
  return point;
}

/// Adds a thin line through the points, which are filled, or hollow if some answers are wrong. `k` is the index of
/// the colour.
void add_curves(Json& curves, const std::string& name, int k, const std::vector<Point>& points) {
  const auto add = [&](const std::string& label, const char* look, auto&& chosen) {
    Json curve = {{"label", label}, {"id", name}, {"k", k}, {"look", look}};
    for (const Point& point : points)
      if (chosen(point)) {
        curve["x"].push_back(point.x);
        curve["value"].push_back(point.y);
        curve["notes"].push_back(point.note);
      }
    if (curve.contains("x")) curves.push_back(curve);
  };
  add(name, "line", [](const Point&) { return true; });
  add(name, "full", [](const Point& point) { return !point.hollow; });
  add(name + ", some wrong", "hollow", [](const Point& point) { return point.hollow; });
}

// ---- the answer -------------------------------------------------------------------------------------

struct Range {
  double low = INFINITY, high = -INFINITY;

  void add(double value) {
    if (std::isnan(value)) return;
    low = std::min(low, value), high = std::max(high, value);
  }
  bool is_empty() const { return low > high; }
  std::string text() const {
    const std::string one = ratio_text(low), other = ratio_text(high);
    return one == other ? one : one + " to " + other;
  }
};

struct Summary {
  double pairs = 0, wrong = 0, worst = 0;
  std::string worst_case;
  Range cost, error;  ///< `cost` is relative to the first method
};

Summary summary_of(const Part& part, const Json& rows, const std::string& method) {
  Summary of;
  const std::string first = methods_of(rows).front();
  std::map<std::string, double> costs;
  for (const Json& row : rows)
    if (method_of(row) == first)
      costs.try_emplace(compared_name(part, row), number_at(row, part.cost.key));
  for (const Json& row : rows) {
    if (method_of(row) != method || !applies(row)) continue;
    const std::string name = compared_name(part, row);
    if (is_comparable(part) && costs.contains(name))
      of.cost.add(number_at(row, part.cost.key) / costs.at(name));
    of.error.add(number_at(row, part.error.key));
    if (part.verdicts.empty()) continue;
    const double pairs = number_at(row, "pairs"), share = wrong(part, row) / pairs;
    of.pairs += pairs;
    of.wrong += wrong(part, row);
    if (share > of.worst) of.worst = share, of.worst_case = name;
  }
  return of;
}

}  // namespace

std::string time_text(double nanoseconds) {
  static constexpr std::array<const char*, 4> units = {"ns", "µs", "ms", "s"};
  if (std::isnan(nanoseconds)) return "–";
  double value = nanoseconds;
  std::size_t unit = 0;
  while (value >= 999.5 && unit + 1 < units.size()) value /= 1000, ++unit;
  return fmt::format("{:.{}f} {}", value, value < 9.995 ? 2 : value < 99.95 ? 1 : 0, units[unit]);
}

std::string error_text(double error) {
  if (std::isnan(error)) return "–";
  return error == 0 ? "0" : fmt::format("{:.1e}", error);
}

std::string ratio_text(double ratio) {
  return ratio < 999.5 ? fmt::format("{:.3g}", ratio) : fmt::format("{:.0f}", ratio);
}

std::string share_text(double share) {
  if (share == 0) return "·";
  const double percent = 100 * share;
  return fmt::format("{:.{}g} %", percent, percent >= 99.5 ? 3 : percent >= 1 ? 2 : 1);
}

std::vector<StudyTable> tables_of(const Part& part, const Json& rows) {
  std::vector<StudyTable> tables;
  if (!part.verdicts.empty() && is_comparable(part))
    tables.push_back(matrix(part, rows, Content::wrong_answers, "Wrong answers",
                            [&](const Json& row, const Json*) { return failure_cell(part, row); }));
  if (!part.cost.key.empty() && is_comparable(part) && methods_of(rows).size() > 1)
    tables.push_back(
        matrix(part, rows, Content::costs,
               heading_of(part.cost) + " of the first method, and of the others relative to it",
               [&](const Json& row, const Json* first) { return cost_cell(part, row, first); }));
  tables.push_back(all_rows(part, rows));
  return tables;
}

Json charts_of(const Part& part, const Json& rows) {
  Json charts = Json::array();
  const bool has_error = !part.error.key.empty();
  if (part.cost.key.empty() || (!has_error && part.varied.empty())) return charts;
  const Column& y = has_error ? part.error : part.cost;
  const std::vector<std::string> names = distinct(rows, curve_of);
  for (const std::string& of : cases_of(part, rows)) {
    Json curves = Json::array();
    for (std::size_t k = 0; k < names.size(); ++k) {
      std::vector<Point> points;
      for (const Json& row : rows) {
        if (case_name(part, row) != of || curve_of(row) != names[k] || !applies(row)) continue;
        if (const Point point = point_of(part, row); point.x > 0 && point.y > 0)
          points.push_back(point);
      }
      add_curves(curves, names[k].empty() ? y.key : names[k], static_cast<int>(k), points);
    }
    if (curves.empty()) continue;
    charts.push_back({{"heading", of.empty() ? part.name : of},
                      {"xSymbol", has_error ? name_of(part.cost) : part.varied},
                      {"xUnit", !has_error                       ? ""
                                : part.cost.shown == Shown::time ? "ns"
                                                                 : part.cost.unit},
                      {"symbol", name_of(y)},
                      {"unit", y.shown == Shown::time ? "ns" : y.unit},
                      {"curves", curves}});
  }
  return charts;
}

std::string answer_of(const Part& part, const Json& rows) {
  if (rows.empty() || part.cost.key.empty()) return "";
  const std::vector<std::string> methods = methods_of(rows);
  std::vector<std::string> right, wrong;
  for (const std::string& method : methods) {
    const Summary of = summary_of(part, rows, method);
    if (of.wrong > 0) {
      wrong.push_back(fmt::format("{} {} ({}: {})", method, share_text(of.wrong / of.pairs),
                                  of.worst_case, share_text(of.worst)));
      continue;
    }
    std::vector<std::string> facts;
    if (method != methods.front() && !of.cost.is_empty())
      facts.push_back(of.cost.text() + " times the cost");
    if (of.error.high > 0 && !of.error.is_empty())
      facts.push_back("error up to " + error_text(of.error.high));
    if (!facts.empty() || of.pairs > 0)
      right.push_back(facts.empty() ? method
                                    : fmt::format("{} ({})", method, fmt::join(facts, ", ")));
  }
  std::string text;
  if (!right.empty())
    text =
        (part.verdicts.empty() ? "" : "Never wrong: ") + fmt::format("{}", fmt::join(right, "; "));
  if (!wrong.empty())
    text += (text.empty() ? "Wrong: " : ". Wrong, at most in: ") +
            fmt::format("{}", fmt::join(wrong, "; "));
  return text.empty() ? text : text + ".";
}

std::string markdown(const StudyTable& table) {
  std::string text;
  const auto add = [&](const auto& cells, auto&& text_of) {
    text += '|';
    for (const auto& cell : cells) text += ' ' + text_of(cell) + " |";
    text += '\n';
  };
  add(table.head, [](const std::string& name) { return name; });
  add(table.head, [](const std::string&) { return std::string("---"); });
  for (const std::vector<Cell>& row : table.rows)
    add(row, [](const Cell& cell) { return cell.text; });
  return text;
}

Json table_json(const StudyTable& table) {
  Json rows = Json::array();
  for (const std::vector<Cell>& row : table.rows) {
    Json line = Json::array();
    for (const Cell& cell : row) {
      if (cell.note.empty())
        line.push_back(cell.text);
      else
        line.push_back({{"text", cell.text},
                        {"title", cell.note},
                        {"class", cell.wrong == 0     ? ""
                                  : cell.wrong < 0.01 ? "some"
                                  : cell.wrong < 0.1  ? "many"
                                                      : "most"}});
    }
    rows.push_back(line);
  }
  return {{"heading", table.heading}, {"head", table.head}, {"rows", rows}};
}

}  // namespace vitrel::bench
