#include "core/io/parameter_words.h"

#include <algorithm>

namespace vitrel {

std::string wrapped(const std::string& text, const std::string& lead, std::size_t width) {
  std::string result, line = lead;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    if (line.size() > lead.size() && line.size() + 1 + word.size() > width) {
      result += line + "\n";
      line = lead;
    }
    line += (line.size() > lead.size() ? " " : "") + word;
    start = end + 1;
  }
  return result + line + "\n";
}

std::string explanation(const Field& field, const std::string& choices) {
  std::string text = field.sentence;
  if (!choices.empty()) text += " One of " + choices + ".";
  if (!field.unit.empty()) text += " Unit: " + field.unit + ".";
  return text;
}

}  // namespace vitrel
