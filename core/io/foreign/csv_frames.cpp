#include "core/io/foreign/csv_frames.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/io/foreign/particle_table.h"
#include "core/io/foreign/text_lines.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

/// The cells of a line. One in quotes may hold commas, and quotes that are doubled.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const bool is_doubled = quoted && line[k] == '"' && line.substr(k + 1).starts_with('"');
    if (is_doubled)
      cells.back() += line[k++];
    else if (line[k] == '"')
      quoted = !quoted;
    else if (line[k] == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[k];
  }
  return cells;
}

/// "x" of "x [length]".
std::string column_name(const std::string& cell) {
  return std::string(trimmed(std::string_view(cell).substr(0, cell.find('['))));
}

/// The column whose values tell the frames apart, if there is one.
std::optional<std::size_t> frame_column(const std::vector<std::string>& columns) {
  for (const char* name : {"frame", "time"})
    if (const auto found = std::ranges::find(columns, name); found != columns.end())
      return static_cast<std::size_t>(found - columns.begin());
  return std::nullopt;
}

class CsvFrames final : public ForeignFrames {
 public:
  explicit CsvFrames(const fs::path& path)
      : lines_(path),
        columns_(header()),
        frame_column_(frame_column(columns_)),
        table_(columns_, lines_.place()) {
    advance();
  }

  const char* box_crossings() const override {
    return "columns image_x, image_y or unwrapped_x, unwrapped_y";
  }

  bool next(ForeignFrame& frame) override {
    if (cells_.empty()) return false;
    const std::string key = frame_key(), place = lines_.place();
    table_.clear();
    do {
      table_.add({cells_.begin(), cells_.end()}, lines_.place());
      advance();
    } while (!cells_.empty() && frame_key() == key);
    frame = table_.frame(place);
    return true;
  }

 private:
  std::vector<std::string> header() {
    advance();
    if (cells_.empty())
      throw FileError(lines_.path().string() + ": has no line with the names of columns");
    for (std::string& cell : cells_) cell = column_name(cell);
    const auto has = [&](const char* name) { return std::ranges::count(cells_, name) > 0; };
    if (!has("x") && !has("unwrapped_x"))
      throw FileError(
          fmt::format("{}: is neither H5MD, GSD nor extended XYZ, nor CSV, whose first "
                      "line has columns x and y",
                      lines_.path().string()));
    return cells_;
  }

  /// To the next line that counts; at the end there are no cells.
  void advance() {
    std::string line;
    cells_.clear();
    while (cells_.empty() && lines_.next(line))
      if (!line.empty() && line[0] != '#') cells_ = cells_of(line);
  }

  std::string frame_key() const {
    return frame_column_ && *frame_column_ < cells_.size() ? cells_[*frame_column_] : "";
  }

  TextLines lines_;
  std::vector<std::string> cells_;  ///< of the next line
  std::vector<std::string> columns_;
  std::optional<std::size_t> frame_column_;
  ParticleTable table_;
};

}  // namespace

std::unique_ptr<ForeignFrames> open_csv(const fs::path& path) {
  return std::make_unique<CsvFrames>(path);
}

}  // namespace vitrel
