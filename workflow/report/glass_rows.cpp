#include "workflow/report/glass_rows.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "analysis/glass/glass_names.h"
#include "workflow/report/html.h"
#include "workflow/report/page_parts.h"
#include "workflow/report/page_tables.h"

namespace vitrel {

namespace {

constexpr const char* not_within_run = "not within this run";

/// The name of a kind of relaxation time on the page.
std::string kind_text(const std::string& kind) {
  const std::size_t comma = kind.find(',');
  const bool is_translation = kind == name_of(GlassKind::translation);
  return kind.substr(0, comma) + (is_translation ? ", τ<sub>α</sub>" : ", τ<sub>2</sub>");
}

/// Notation that depends on the dimension of a run.
struct Notation {
  std::string unit_of_time, unit_of_length;
  std::string_view correlation;  ///< symbol of the correlation of orientations

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
  /// The meaning of a code; empty if the column is missing.
  std::string word(const char* column) const {
    const Column* found = study.find(table)->find(column);
    return found ? label_of(*found, k).value_or("") : "";
  }
};

std::string html_row(std::string_view head, std::initializer_list<std::string> cells) {
  std::string row = fmt::format("<tr><th scope=\"row\">{}</th>", head);
  for (const std::string& cell : cells) row += table_cell(cell);
  return row + "</tr>\n";
}

std::string rows_of(const Results& study, const char* name, auto&& format) {
  const Table* table = study.find(name);
  std::string rows;
  for (std::size_t k = 0; table && k < table->rows(); ++k) rows += format(Row{study, name, k});
  return rows;
}

std::string relaxation_row(const Row& row, const std::map<std::string, std::string>& labels) {
  const bool nematic = row.value("plateau") > 0;
  const auto label = labels.find(row.word("run"));
  const std::string orientation = row.word("orientation");
  return html_row(
      label == labels.end() ? density_text(row.value("packing_fraction")) : escaped(label->second),
      {row.text("seed"), row.word("verdict_translation"), row.word("verdict"),
       orientation == name_of(OrientationKind::lasting) ? not_within_run : orientation,
       row.text("wave_number"), row.text("tau_translation"), row.text("tau_rotation"),
       row.text("nematic_order"), row.text("nematic_by_chance"),
       nematic ? row.text("plateau") : "–", row.text("duration")});
}

std::string critical_density(const Row& row) {
  const std::string verdict = row.word("verdict");
  if (verdict == name_of(GlassVerdict::found)) return row.text("phi_c");
  const bool bounded =
      verdict == name_of(GlassVerdict::lower_bound) && std::isfinite(row.value("phi_c_least"));
  return bounded ? "&gt; " + row.text("phi_c_least") : "–";
}

std::string fit_row(const Row& row) {
  const double dof = row.value("dof");
  return html_row(
      kind_text(row.word("kind")),
      {row.word("law"), critical_density(row), row.text("exponent"),
       dof > 0 ? fmt::format("{} … {}", row.text("window_low"), row.text("window_high")) : "–",
       dof > 0 ? fmt::format("{:.2f}", row.value("chi2") / dof) : "–",
       dof > 0 ? row.text("scatter") : "–"});
}

/// The verdict with its reason: "ageing: S drifts". `reason` is the key of the reason in the provenance.
std::string verdict_text(const Row& row, const char* column, const char* reason) {
  const std::string why = row.study.text(reason);
  return row.word(column) + (why.empty() ? "" : ": " + escaped(why));
}

std::string verdict_rows(const Row& row) {
  std::string all = html_row("equilibrium", {verdict_text(row, "verdict", "verdict_reason"), ""});
  if (row.word("verdict") == row.word("verdict_translation")) return all;
  return all +
         html_row("of translation alone",
                  {verdict_text(row, "verdict_translation", "verdict_translation_reason"), ""});
}

/// A relaxation time, or a bound if the time is not known.
std::string time_text(const Row& row, const std::string& unit_of_time) {
  if (std::isfinite(row.value("tau"))) return row.text("tau") + unit_of_time;
  if (std::isfinite(row.value("least")))
    return fmt::format("{}: &gt; {}{}", not_within_run, row.text("least"), unit_of_time);
  return std::isfinite(row.value("most")) ? "&lt; " + row.text("most") + unit_of_time : "–";
}

/// The row of a relaxation time of all particles together, which are group 0; empty for other groups.
std::string time_row(const Row& row, const Notation& notation) {
  if (row.value("group") != 0) return "";
  const std::string parameter = row.text("parameter");
  const std::string time = time_text(row, notation.unit_of_time);
  constexpr std::string_view scattering = "self scattering", orientation = "orientation";
  const std::string kind = row.word("kind");
  const bool is_translation = kind.starts_with(scattering);
  // The text is "… relative to the cage" or "… of the middle axis".
  const std::string what = kind.substr(is_translation ? scattering.size() : orientation.size());
  if (is_translation)
    return html_row(fmt::format("relaxation time τ<sub>α</sub>{}", what),
                    {time, fmt::format("F<sub>s</sub>(q, t) = 1/e at q = {}/{}", parameter,
                                       notation.unit_of_length)});
  return html_row(fmt::format("rotational relaxation time τ<sub>{}</sub>{}", parameter, what),
                  {time, fmt::format("{}<sub>{}</sub>(t) = 1/e", notation.correlation, parameter)});
}

/// The row of the relaxation of orientations in a nematic, apart from what its order keeps; empty if not nematic.
std::string director_row(const Row& row, const Notation& notation) {
  if (!(row.value("plateau") > 0)) return "";
  const bool known = std::isfinite(row.value("tau_rotation"));
  return html_row("seen from the director",
                  {known ? row.text("tau_rotation") + notation.unit_of_time : not_within_run,
                   fmt::format("{}<sub>2</sub> 1/e above its plateau by order, {}",
                               notation.correlation, row.text("plateau"))});
}

/// The rows of averages over the run that are known.
std::string average_rows(const Results& run, const PageUnits& units) {
  struct Average {
    const char *head, *column;
    const char* square;  ///< the mean square whose slope it is, if any
  };
  constexpr Average averages[] = {
      {"compressibility factor Z = βP/ρ", "compressibility_factor", nullptr},
      {"diffusion coefficient D", "diffusion", "mean squared displacement"},
      {"rotational diffusion coefficient D<sub>r</sub>", "rotational_diffusion",
       "mean squared rotation"}};
  std::string rows;
  for (const auto& [head, name, square] : averages) {
    const Row row{run, "summary", 0};
    if (!std::isfinite(row.value(name))) continue;
    const std::string unit = unit_name(run.find("summary")->find(name)->unit, units);
    const std::string column = name;
    rows += html_row(head, {row.text(name) + (unit.empty() ? "" : " " + escaped(unit)),
                            square ? fmt::format("slope of the {} from t = {} to {}", square,
                                                 row.text((column + "_from").c_str()),
                                                 row.text((column + "_to").c_str()))
                                   : ""});
  }
  return rows;
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
         average_rows(run, page_units(dimension, units)) +
         rows_of(run, "relaxation_times", with_notation(time_row)) +
         rows_of(run, "relaxation", with_notation(director_row));
}

std::string relaxation_rows(const Results& study,
                            const std::map<std::string, std::string>& labels) {
  return rows_of(study, "relaxation", [&](const Row& row) { return relaxation_row(row, labels); });
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
