#include "workflow/report/glass_rows.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

#include "analysis/glass/glass_names.h"
#include "workflow/report/html.h"
#include "workflow/report/page_parts.h"
#include "workflow/report/page_tables.h"

namespace vitrel {

namespace {

// What the numbers in the tables stand for.
constexpr std::array<std::string_view, 3> kinds = {"translation, τ<sub>α</sub>",
                                                   "rotation, τ<sub>2</sub>",
                                                   "rotation in the nematic, τ<sub>2</sub>"};
constexpr double found = 0, lower_bound = 1;
constexpr const char* not_within_run = "not within this run";

/// What depends on the dimension of a run.
struct Notation {
  std::string unit_of_time, unit_of_length;
  std::string_view correlation;  ///< of orientations

  Notation(int dimension, const std::optional<FileUnits>& units)
      : unit_of_time(" " + page_units(dimension, units).time),
        unit_of_length(page_units(dimension, units).length),
        correlation(dimension == 2 ? "L" : "P") {}
};

/// One row of a table.
struct Row {
  const Results& study;
  const char* table;
  std::size_t k;

  double value(const char* column) const { return table_value(study, table, column, k); }
  std::string text(const char* column) const { return table_text(study, table, column, k); }
  template <std::size_t n>
  std::string_view word(const char* column, const std::array<std::string_view, n>& words) const {
    const double code = value(column);
    return code >= 0 && code < n ? words[static_cast<std::size_t>(code)] : "–";
  }
};

std::string html_row(std::string_view head, std::initializer_list<std::string> cells) {
  std::string row = fmt::format("<tr><th scope=\"row\">{}</th>", head);
  for (const std::string& cell : cells) row += "<td>" + cell + "</td>";
  return row + "</tr>\n";
}

template <class Format>
std::string rows_of(const Results& study, const char* name, Format&& format) {
  const Table* table = study.find(name);
  std::string rows;
  for (std::size_t k = 0; table && k < table->rows(); ++k) rows += format(Row{study, name, k});
  return rows;
}

std::string relaxation_row(const Row& row) {
  const bool nematic = row.value("plateau") > 0;
  auto orientations = orientation_names;
  orientations[static_cast<std::size_t>(OrientationKind::lasting)] = not_within_run;
  return html_row(
      density_text(row.value("packing_fraction")),
      {row.text("seed"), std::string(row.word("verdict_translation", verdict_names)),
       std::string(row.word("verdict", verdict_names)),
       std::string(row.word("orientation", orientations)), row.text("wave_number"),
       row.text("tau_translation"), row.text("tau_rotation"), row.text("nematic_order"),
       row.text("nematic_by_chance"), nematic ? row.text("plateau") : "–", row.text("duration")});
}

std::string critical_density(const Row& row) {
  if (row.value("verdict") == found) return row.text("phi_c");
  const bool bounded =
      row.value("verdict") == lower_bound && std::isfinite(row.value("phi_c_least"));
  return bounded ? "&gt; " + row.text("phi_c_least") : "–";
}

std::string fit_row(const Row& row) {
  const double dof = row.value("dof");
  return html_row(
      row.word("kind", kinds),
      {std::string(row.word("law", law_names)), critical_density(row), row.text("exponent"),
       dof > 0 ? fmt::format("{} … {}", row.text("window_low"), row.text("window_high")) : "–",
       dof > 0 ? fmt::format("{:.2f}", row.value("chi2") / dof) : "–",
       dof > 0 ? row.text("scatter") : "–"});
}

/// "ageing: S drifts", with the reason of that name.
std::string verdict_text(const Row& row, const char* column, const char* reason) {
  const std::string why = row.study.text(reason);
  return std::string(row.word(column, verdict_names)) + (why.empty() ? "" : ": " + escaped(why));
}

std::string verdict_rows(const Row& row) {
  std::string all = html_row("equilibrium", {verdict_text(row, "verdict", "verdict_reason"), ""});
  if (row.value("verdict") == row.value("verdict_translation")) return all;
  return all +
         html_row("of translation alone",
                  {verdict_text(row, "verdict_translation", "verdict_translation_reason"), ""});
}

/// A relaxation time, or a bound of it.
std::string time_text(const Row& row, const std::string& unit_of_time) {
  if (std::isfinite(row.value("tau"))) return row.text("tau") + unit_of_time;
  if (std::isfinite(row.value("least")))
    return fmt::format("{}: &gt; {}{}", not_within_run, row.text("least"), unit_of_time);
  return std::isfinite(row.value("most")) ? "&lt; " + row.text("most") + unit_of_time : "–";
}

/// Of all particles together, which are group 0.
std::string time_row(const Row& row, const Notation& notation) {
  if (row.value("group") != 0) return "";
  const std::string parameter = row.text("parameter");
  const std::string time = time_text(row, notation.unit_of_time);
  constexpr std::array<std::string_view, 5> of_what = {
      "", "", " of the middle axis", " of the shortest axis", " relative to the cage"};
  const std::string_view what = row.word("kind", of_what);
  const double kind = row.value("kind");
  if (kind == 0 || kind == 4)
    return html_row(fmt::format("relaxation time τ<sub>α</sub>{}", what),
                    {time, fmt::format("F<sub>s</sub>(q, t) = 1/e at q = {}/{}", parameter,
                                       notation.unit_of_length)});
  return html_row(fmt::format("rotational relaxation time τ<sub>{}</sub>{}", parameter, what),
                  {time, fmt::format("{}<sub>{}</sub>(t) = 1/e", notation.correlation, parameter)});
}

/// What order does not keep of the orientations of a nematic.
std::string director_row(const Row& row, const Notation& notation) {
  if (!(row.value("plateau") > 0)) return "";
  const bool known = std::isfinite(row.value("tau_rotation"));
  return html_row("seen from the director",
                  {known ? row.text("tau_rotation") + notation.unit_of_time : not_within_run,
                   fmt::format("{}<sub>2</sub> 1/e above its plateau by order, {}",
                               notation.correlation, row.text("plateau"))});
}

}  // namespace

std::string result_rows(const Results& run, int dimension, const std::optional<FileUnits>& units) {
  const Notation notation(dimension, units);
  const auto with_notation = [&notation](auto* row_text) {
    return [&notation, row_text](const Row& row) { return row_text(row, notation); };
  };
  const std::string not_judged = run.text("not_judged");
  return (not_judged.empty()
              ? rows_of(run, "relaxation", verdict_rows)
              : html_row("equilibrium", {"not judged: " + escaped(not_judged), ""})) +
         rows_of(run, "relaxation_times", with_notation(time_row)) +
         rows_of(run, "relaxation", with_notation(director_row));
}

std::string relaxation_rows(const Results& study) {
  return rows_of(study, "relaxation", relaxation_row);
}

std::string fit_rows(const Results& study) {
  return rows_of(study, "glass_fit", fit_row);
}

std::string study_notes(const Results& study) {
  std::string items;
  for (const auto& [name, text] : study.provenance)
    if (name.starts_with("note_")) items += "<li>" + escaped(text) + "</li>\n";
  return items.empty() ? items : "<ul class=\"note\">\n" + items + "</ul>\n";
}

}  // namespace vitrel
