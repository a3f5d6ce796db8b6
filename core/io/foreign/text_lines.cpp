#include "core/io/foreign/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "core/error.h"

namespace vitrel {

std::string_view trimmed(std::string_view text) {
  constexpr const char* blank = " \t\r";
  const std::size_t begin = text.find_first_not_of(blank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

std::vector<std::string_view> words_of(std::string_view line, const char* separators) {
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(separators); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(separators, end);
  }
  return words;
}

std::optional<double> number_in(std::string_view text) {
  // from_chars does not accept a sign in front of a positive number.
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (stop != end && (*stop == 'D' || *stop == 'd')) {
    std::string in_c(text);
    in_c[static_cast<std::size_t>(stop - text.data())] = 'e';
    return number_in(in_c);
  }
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

TextLines::TextLines(const std::filesystem::path& path) : path_(path), stream_(path) {
  if (!stream_)
    throw FileError(
        fmt::format("{}: cannot open the file: {}", path.string(), std::strerror(errno)));
}

bool TextLines::next(std::string& line) {
  if (!std::getline(stream_, line)) {
    if (stream_.bad()) throw FileError(path_.string() + ": cannot read the file");
    return false;
  }
  constexpr const char* byte_order_mark = "\xEF\xBB\xBF";
  if (number_++ == 0 && line.starts_with(byte_order_mark)) line.erase(0, 3);
  if (line.ends_with('\r')) line.pop_back();
  return true;
}

std::string TextLines::place() const {
  return fmt::format("{}:{}", path_.string(), number_);
}

}  // namespace vitrel
