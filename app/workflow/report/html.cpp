#include "app/workflow/report/html.h"

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

std::string provenance_entries(const PageProvenance& provenance) {
  std::string list;
  for (const auto& [name, text] : provenance)
    if (!text.empty())
      list += "<div><dt>" + escaped(name) + "</dt><dd>" + escaped(text) + "</dd></div>\n";
  return list;
}

}  // namespace vitrel
