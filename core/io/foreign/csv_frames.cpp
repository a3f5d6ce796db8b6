#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/io/foreign/foreign_formats.h"
#include "core/io/foreign/particle_table.h"
#include "core/io/foreign/text_lines.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

/// Returns the cells of a line. A cell in quotes may hold commas, and quotes that are doubled.
std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const bool is_doubled = quoted && line[k] == '"' && line.substr(k + 1).starts_with('"');
    if (is_doubled)
      cells.back() += line[k++];
    else if (line[k] == '"')
      quoted = !quoted;
    else if (line[k] == separator && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[k];
  }
  return cells;
}

/// Returns "x" for "x [length]".
std::string column_name(const std::string& cell) {
  return std::string(trimmed(std::string_view(cell).substr(0, cell.find('['))));
}

/// Returns "length" for "x [length]".
std::string column_unit(const std::string& cell) {
  const std::size_t begin = cell.find('['), end = cell.find(']', begin);
  if (begin == std::string::npos || end == std::string::npos) return "";
  return std::string(trimmed(std::string_view(cell).substr(begin + 1, end - begin - 1)));
}

constexpr std::array<std::string_view, 17> length_columns = {
    "x",      "y",        "z",          "unwrapped_x", "unwrapped_y", "unwrapped_z",
    "a",      "b",        "c",          "box_x",       "box_y",       "box_z",
    "radius", "diameter", "diameter_x", "diameter_y",  "diameter_z"};

/// Returns the column whose values tell the frames apart, if there is one.
std::optional<std::size_t> frame_column(const std::vector<std::string>& columns) {
  for (const char* name : {"frame", "time"})
    if (const auto found = std::ranges::find(columns, name); found != columns.end())
      return static_cast<std::size_t>(found - columns.begin());
  return std::nullopt;
}

class CsvFrames final : public ForeignFrames {
 public:
  CsvFrames(const fs::path& path, const ImportOptions& options)
      : lines_(path),
        columns_(header()),
        frame_column_(frame_column(columns_)),
        table_(columns_, lines_.place(), options.columns) {
    advance();
  }

  FileUnits units() const override { return units_; }

  bool next(ForeignFrame& frame) override {
    if (cells_.empty()) return false;
    const std::string key = frame_key(), place = lines_.place();
    table_.clear();
    do {
      table_.add({cells_.begin(), cells_.end()}, lines_.place());
      advance();
    } while (!cells_.empty() && frame_key() == key);
    frame = table_.frame(place);
    frame.assumed["boundaries"] = "periodic, which this format cannot state";
    return true;
  }

 private:
  std::vector<std::string> header() {
    advance();
    if (cells_.empty())
      throw FileError(lines_.path().string() + ": has no line with the names of columns");
    if (cells_.size() == 1 && cells_.front().find('\t') != std::string::npos) {
      separator_ = '\t';
      cells_ = cells_of(cells_.front(), separator_);
    }
    require_units(cells_);
    for (std::string& cell : cells_) cell = column_name(cell);
    return cells_;
  }

  void require_units(const std::vector<std::string>& cells) {
    StatedUnits units;
    for (const std::string& cell : cells) {
      const std::string name = column_name(cell), unit = column_unit(cell);
      if (name == "time") units.time = unit;
      if (std::ranges::find(length_columns, name) != length_columns.end())
        units.lengths.emplace_back("column " + name, unit);
      if (name == "angle") units.angles.emplace_back("column " + name, unit);
      if (name == "vx" || name == "vy" || name == "vz")
        units.velocities.emplace_back("column " + name, unit);
    }
    with_place(lines_.place(), [&] { units_ = require_agreement(units); });
  }

  /// Moves to the next line that is not skipped; at the end there are no cells.
  void advance() {
    std::string line;
    cells_.clear();
    while (cells_.empty() && lines_.next(line))
      if (!line.empty() && line[0] != '#') cells_ = cells_of(line, separator_);
  }

  std::string frame_key() const {
    return frame_column_ && *frame_column_ < cells_.size() ? cells_[*frame_column_] : "";
  }

  TextLines lines_;
  char separator_ = ',';
  FileUnits units_;
  std::vector<std::string> cells_;  ///< cells of the next line
  std::vector<std::string> columns_;
  std::optional<std::size_t> frame_column_;
  ParticleTable table_;
};

/// Returns whether the first line that is not skipped has several names.
bool is_csv(std::string_view start) {
  if (start.find('\0') != std::string_view::npos) return false;
  while (start.starts_with('#') || start.starts_with('\n') || start.starts_with('\r'))
    start.remove_prefix(std::min(start.find('\n'), start.size() - 1) + 1);
  return start.substr(0, start.find('\n')).find_first_of(",\t") != std::string_view::npos;
}

}  // namespace

constexpr ForeignFormat csv_format = {
    "CSV",
    {"columns box_x and box_y", "leaving out the column z", "columns a and b, or radius",
     "columns image_x, image_y or unwrapped_x, unwrapped_y"},
    is_csv,
    [](const fs::path& path, const ImportOptions& options) -> std::unique_ptr<ForeignFrames> {
      return std::make_unique<CsvFrames>(path, options);
    }};

}  // namespace vitrel
