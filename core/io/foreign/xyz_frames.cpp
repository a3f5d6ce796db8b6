#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/io/foreign/foreign_formats.h"
#include "core/io/foreign/particle_table.h"
#include "core/io/foreign/text_lines.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

using Keys = std::map<std::string, std::string>;

/// The columns of a property, as ParticleTable knows them.
const std::map<std::string, std::vector<std::string>> columns_of = {
    {"type", {"species"}},
    {"species", {"species"}},
    {"pos", {"x", "y", "z"}},
    {"id", {"id"}},
    {"map_shift", {"image_x", "image_y", "image_z"}},
    {"angle", {"angle"}},
    {"orientation", {"qx", "qy", "qz", "qw"}},
    {"aspherical_shape", {"a", "b", "c"}},
    {"radius", {"radius"}},
    {"mass", {"mass"}},
    {"masses", {"mass"}},
    {"velo", {"vx", "vy", "vz"}},
    {"vel", {"vx", "vy", "vz"}},
    {"velocities", {"vx", "vy", "vz"}},
    {"omega", {"omega_x", "omega_y", "omega_z"}}};

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Returns where the value that begins at `begin` ends: behind its quotes or brackets, or at the next blank.
std::size_t end_of_value(const std::string& line, std::size_t begin) {
  if (begin < line.size() && line[begin] == '"')
    return std::min(line.find('"', begin + 1), line.size() - 1) + 1;
  int open = 0;
  for (std::size_t k = begin; k < line.size(); ++k) {
    open += (line[k] == '[' || line[k] == '{') - (line[k] == ']' || line[k] == '}');
    if (open <= 0 && (line[k] == ' ' || line[k] == '\t')) return k;
  }
  return line.size();
}

/// Reads key=value, key="several words" and key=[[lists], [of, lists]], with or without blanks around =. Words
/// without = are skipped.
Keys keys_of(const std::string& line) {
  Keys keys;
  const auto skip_blanks = [&](std::size_t k) {
    return std::min(line.find_first_not_of(" \t", k), line.size());
  };
  for (std::size_t k = skip_blanks(0); k < line.size(); k = skip_blanks(k)) {
    const std::size_t end = std::min(line.find_first_of(" \t=", k), line.size());
    const std::string key = lower_case(line.substr(k, end - k));
    const std::size_t sign = skip_blanks(end);
    k = std::max(end, k + 1);
    if (sign == line.size() || line[sign] != '=') continue;
    const std::size_t begin = skip_blanks(sign + 1);
    k = end_of_value(line, begin);
    std::string value = line.substr(begin, k - begin);
    std::erase(value, '"');
    keys[key] = value;
  }
  return keys;
}

[[noreturn]] void throw_no_number(std::string_view text, const std::string& what,
                                  const std::string& place) {
  throw FileError(fmt::format("{}: {} is \"{}\", but should be a number", place, what, text));
}

double real_number(std::string_view text, const std::string& what, const std::string& place) {
  const std::optional<double> value = number_in(text);
  if (!value) throw_no_number(text, what, place);
  return *value;
}

template <class Number>
Number parsed(std::string_view text, const std::string& what, const std::string& place) {
  Number value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) throw_no_number(text, what, place);
  return value;
}

std::vector<double> numbers(const std::string& text, std::size_t count, const std::string& what,
                            const std::string& place) {
  std::vector<double> values;
  for (const std::string_view word : words_of(text, " \t,[]{}"))
    values.push_back(real_number(word, what, place));
  if (values.size() != count)
    throw FileError(fmt::format("{}: {} has {} numbers, but should have {}", place, what,
                                values.size(), count));
  return values;
}

/// Returns the names of all columns. A property that is not known, or has another number of columns, keeps its name.
std::vector<std::string> columns(const std::string& properties, const std::string& place) {
  const std::vector<std::string_view> parts = words_of(properties, ":");
  if (parts.size() % 3 != 0)
    throw FileError(
        fmt::format("{}: should have Properties=name:type:columns:…, as extended XYZ does", place));
  constexpr std::size_t most = 100;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < parts.size(); k += 3) {
    const std::string property = lower_case(std::string(parts[k]));
    const auto count = parsed<std::size_t>(parts[k + 2], "a number of columns", place);
    if (count > most)
      throw FileError(fmt::format("{}: the property {} has {} columns", place, property, count));
    const auto known = columns_of.find(property);
    if (known != columns_of.end() && known->second.size() == count)
      names.insert(names.end(), known->second.begin(), known->second.end());
    else
      for (std::size_t column = 1; column <= count; ++column)
        names.push_back(count == 1 ? property : fmt::format("{}[{}]", property, column));
  }
  return names;
}

/// Returns the columns of plain XYZ, which does not name them; all programs agree on the first four.
std::vector<std::string> plain_columns(std::size_t count) {
  std::vector<std::string> names = {"species", "x", "y", "z"};
  while (names.size() < count) names.push_back(fmt::format("column {}", names.size() + 1));
  return names;
}

class XyzFrames final : public ForeignFrames {
 public:
  XyzFrames(const fs::path& path, const ImportOptions& options)
      : lines_(path), renamed_(options.columns) {}

  bool next(ForeignFrame& frame) override {
    std::string line;
    do {
      if (!lines_.next(line)) return false;
    } while (words_of(line).empty());
    const auto words = words_of(line);
    const std::string place = lines_.place();
    const auto n = parsed<std::size_t>(words.size() == 1 ? words[0] : std::string_view(line),
                                       "the number of particles", place);
    const Keys keys = keys_of(next_line("the keys"));
    const std::string place_of_keys = lines_.place();
    std::optional<ParticleTable> table;
    for (std::size_t i = 0; i < n; ++i) {
      const std::string particle = next_line(fmt::format("particle {} of {}", i, n));
      const std::vector<std::string_view> cells = words_of(particle);
      if (!table) table.emplace(table_columns(keys, cells, place_of_keys), place_of_keys, renamed_);
      table->add(cells, lines_.place());
    }
    frame = table ? table->frame(place) : ForeignFrame();
    complete(frame, keys, place_of_keys);
    return true;
  }

 private:
  std::string next_line(const std::string& what) {
    std::string line;
    if (!lines_.next(line))
      throw FileError(fmt::format("{}: the file ends before {}", lines_.place(), what));
    return line;
  }

  static std::vector<std::string> table_columns(const Keys& keys,
                                                const std::vector<std::string_view>& cells,
                                                const std::string& place) {
    const auto properties = keys.find("properties");
    return properties == keys.end() ? plain_columns(cells.size())
                                    : columns(properties->second, place);
  }

  static void complete(ForeignFrame& frame, const Keys& keys, const std::string& place);

  TextLines lines_;
  std::vector<ImportOptions::Column> renamed_;
};

/// Returns whether a word of `pbc` says that the box is periodic; nothing if the word says neither.
std::optional<bool> periodicity(std::string_view word) {
  if (word == "t" || word == "true" || word == "1") return true;
  if (word == "f" || word == "false" || word == "0") return false;
  return std::nullopt;
}

/// Returns the dimension that follows from pbc, if one does.
std::optional<int> dimension_of_pbc(const Keys& keys, const std::string& place) {
  const auto pbc = keys.find("pbc");
  if (pbc == keys.end()) return std::nullopt;
  const std::string text = lower_case(pbc->second);
  std::vector<bool> periodic;
  for (const std::string_view word : words_of(text, " \t,[]{}"))
    if (const auto is_periodic = periodicity(word)) periodic.push_back(*is_periodic);
  if (periodic.size() != 3)
    throw FileError(fmt::format("{}: pbc is \"{}\", but should be T or F for each of x, y and z",
                                place, pbc->second));
  return with_place(place, [&] {
    return dimension_of_boundaries({periodic[0], periodic[1], periodic[2]},
                                   fmt::format("pbc=\"{}\"", pbc->second));
  });
}

void set_box(ForeignFrame& frame, const Keys& keys, const std::string& place) {
  const auto lattice = keys.find("lattice");
  if (lattice == keys.end()) return;
  const std::vector<double> edges = numbers(lattice->second, 9, "Lattice", place);
  for (int k = 0; k < 9; ++k)
    if (k % 4 != 0 && edges[k] != 0)
      throw FileError(place + ": the box should be a cuboid with edges along x, y and z");
  frame.box = Vec3(edges[0], edges[4], edges[8]);
  Vec3 centre = 0.5 * *frame.box;
  if (const auto origin = keys.find("origin"); origin != keys.end())
    centre += Vec3(numbers(origin->second, 3, "Origin", place).data());
  for (Vec3& position : frame.position) position -= centre;
}

void XyzFrames::complete(ForeignFrame& frame, const Keys& keys, const std::string& place) {
  set_box(frame, keys, place);
  // All programs write three coordinates, so the table does not tell the dimension.
  if (const auto dimension = dimension_of_pbc(keys, place)) frame.dimension = dimension;
  if (!keys.contains("pbc")) frame.assumed["boundaries"] = "periodic";
  if (const auto time = keys.find("time"); time != keys.end())
    frame.time = real_number(time->second, "Time", place);
  for (const char* key : {"step", "timestep"})
    if (const auto step = keys.find(key); step != keys.end())
      frame.step = parsed<std::int64_t>(step->second, "Step", place);
}

/// Returns whether the first line is a number.
bool is_xyz(std::string_view start) {
  const std::vector<std::string_view> words = words_of(start.substr(0, start.find('\n')), " \t\r");
  return words.size() == 1 &&
         std::ranges::all_of(words.front(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

constexpr ForeignFormat xyz_format = {
    "extended XYZ",
    {"Lattice=\"…\"", "pbc=\"T T F\"", "property aspherical_shape or radius", "property map_shift"},
    is_xyz,
    [](const fs::path& path, const ImportOptions& options) -> std::unique_ptr<ForeignFrames> {
      return std::make_unique<XyzFrames>(path, options);
    }};

}  // namespace vitrel
