#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vitrel {

/// Returns the text without the blanks around it.
std::string_view trimmed(std::string_view text);

/// Returns the words between `separators`.
std::vector<std::string_view> words_of(std::string_view line, const char* separators = " \t");

/// Returns a number in C or Fortran notation (1e3, +1, 1.0D+03), or nothing if the text is something else.
std::optional<double> number_in(std::string_view text);

/// The lines of a text file, without their ends (of Unix or Windows) and without a mark of UTF-8 at the start. Throws
/// FileError.
class TextLines {
 public:
  explicit TextLines(const std::filesystem::path& path);

  /// Reads the next line. Returns false at the end of the file.
  bool next(std::string& line);
  /// Returns "file:line" for the last line.
  std::string place() const;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t number_ = 0;
};

}  // namespace vitrel
