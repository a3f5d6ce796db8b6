#include "workflow/sweep/text_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace vitrel {
namespace {

/// In characters, not bytes.
std::size_t width_of(const std::string& utf8) {
  return static_cast<std::size_t>(
      std::ranges::count_if(utf8, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string text_table(const std::vector<std::vector<std::string>>& rows, std::size_t texts) {
  std::vector<std::string> text(rows.size());
  for (std::size_t k = 0; k < rows[0].size(); ++k) {
    const auto is_missing = [k](const auto& row) { return row[k] == missing_cell; };
    if (rows.size() > 1 && std::all_of(rows.begin() + 1, rows.end(), is_missing)) continue;
    std::size_t width = 0;
    for (const auto& row : rows) width = std::max(width, width_of(row[k]));
    for (std::size_t n = 0; n < rows.size(); ++n)
      text[n] += k < texts ? fmt::format("{:<{}}  ", rows[n][k], width)
                           : fmt::format("{:>{}}  ", rows[n][k], width);
  }
  std::string all;
  for (std::string& line : text) all += line.erase(line.find_last_not_of(' ') + 1) + '\n';
  return all;
}

}  // namespace vitrel
