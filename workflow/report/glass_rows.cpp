#include "workflow/report/glass_rows.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "analysis/glass/glass_names.h"
#include "workflow/report/html.h"
#include "workflow/report/page_tables.h"

namespace vitrel {

namespace {

// What the numbers in the tables stand for.
constexpr std::array<std::string_view, 3> kinds = {"translation, τ<sub>α</sub>",
                                                   "rotation, τ<sub>2</sub>",
                                                   "rotation in the nematic, τ<sub>2</sub>"};
constexpr double found = 0, lower_bound = 1;

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
  return html_row(
      density_text(row.value("packing_fraction")),
      {row.text("seed"), std::string(row.word("verdict_translation", verdict_names)),
       std::string(row.word("verdict", verdict_names)),
       std::string(row.word("orientation", orientation_names)), row.text("tau_translation"),
       row.text("tau_rotation"), row.text("nematic_order"), row.text("nematic_by_chance"),
       nematic ? row.text("plateau") : "–", row.text("duration")});
}

std::string critical_density(const Row& row) {
  if (row.value("verdict") == found) return row.text("phi_c");
  return row.value("verdict") == lower_bound ? "&gt; " + row.text("phi_c_least") : "–";
}

std::string fit_row(const Row& row) {
  const double dof = row.value("dof");
  return html_row(
      row.word("kind", kinds),
      {std::string(row.word("law", law_names)), critical_density(row),
       row.text("phi_c_statistical"), row.text("phi_c_spread"), row.text("exponent"),
       dof > 0 ? fmt::format("{} … {}", row.text("window_low"), row.text("window_high")) : "–",
       dof > 0 ? fmt::format("{:.2f}", row.value("chi2") / dof) : "–",
       dof > 0 ? row.text("scatter") : "–"});
}

}  // namespace

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
