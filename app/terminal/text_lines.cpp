#include "app/terminal/text_lines.h"

#include <algorithm>
#include <sstream>

namespace vitrel {

std::size_t columns(const std::string& text) {
  const auto begins_a_character = [](char byte) { return (byte & 0xC0) != 0x80; };
  return static_cast<std::size_t>(std::ranges::count_if(text, begins_a_character));
}

std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string lines, word;
  std::size_t column = 0;
  while (words >> word) {
    const bool fits = column + 1 + columns(word) <= width;
    if (column > 0) lines += fits ? ' ' : '\n';
    lines += word;
    column = (column > 0 && fits ? column + 1 : 0) + columns(word);
  }
  return lines;
}

std::string indented(const std::string& text, std::size_t count) {
  std::string result;
  for (const char c : text)
    result += c == '\n' ? '\n' + std::string(count, ' ') : std::string(1, c);
  return result;
}

}  // namespace vitrel
