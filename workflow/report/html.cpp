#include "workflow/report/html.h"

namespace vitrel {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string table_cell(const std::string& text) {
  return "<td>" + text + "</td>";
}

std::string provenance_entries(const PageProvenance& provenance) {
  std::string list;
  for (const auto& [name, text] : provenance)
    if (!text.empty())
      list += "<div><dt>" + escaped(name) + "</dt><dd>" + escaped(text) + "</dd></div>\n";
  return list;
}

std::string table_rows(const std::vector<QualityRow>& rows) {
  std::string text;
  for (const QualityRow& row : rows)
    text += "<tr><th scope=\"row\">" + escaped(row.name) + "</th><td>" + escaped(row.value) +
            "</td><td>" + escaped(row.remark) + "</td></tr>\n";
  return text;
}

}  // namespace vitrel
