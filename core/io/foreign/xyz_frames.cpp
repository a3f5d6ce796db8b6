#include "core/io/foreign/xyz_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>

#include "core/error.h"
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

/// Words between `separators`.
std::vector<std::string_view> words_of(std::string_view line, const char* separators = " \t") {
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(separators); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(separators, end);
  }
  return words;
}

/// key=value and key="several words"; words without "=" are skipped.
Keys keys_of(const std::string& line) {
  Keys keys;
  std::size_t k = 0;
  while ((k = line.find_first_not_of(" \t", k)) != std::string::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t=", k), line.size());
    const std::string key = lower_case(line.substr(k, end - k));
    k = end;
    if (k == line.size() || line[k] != '=') continue;
    const bool is_quoted = line.substr(k + 1).starts_with('"');
    const std::size_t begin = k + (is_quoted ? 2 : 1);
    k = std::min(line.find_first_of(is_quoted ? "\"" : " \t", begin), line.size());
    keys[key] = line.substr(begin, k - begin);
    if (is_quoted && k < line.size()) ++k;
  }
  return keys;
}

template <class Number>
Number parsed(std::string_view text, const std::string& what, const std::string& place) {
  Number value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size())
    throw FileError(fmt::format("{}: {} is \"{}\", but should be a number", place, what, text));
  return value;
}

std::vector<double> numbers(const std::string& text, std::size_t count, const std::string& what,
                            const std::string& place) {
  std::vector<double> values;
  for (const std::string_view word : words_of(text))
    values.push_back(parsed<double>(word, what, place));
  if (values.size() != count)
    throw FileError(fmt::format("{}: {} has {} numbers, but should have {}", place, what,
                                values.size(), count));
  return values;
}

/// The names of all columns; a property with another number of them than known is skipped.
std::vector<std::string> columns(const std::string& properties, const std::string& place) {
  const std::vector<std::string_view> parts = words_of(properties, ":");
  if (parts.empty() || parts.size() % 3 != 0)
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
      names.insert(names.end(), count, "");
  }
  return names;
}

class XyzFrames final : public ForeignFrames {
 public:
  explicit XyzFrames(const fs::path& path) : lines_(path) {}

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
    ParticleTable table(columns(value(keys, "properties"), lines_.place()), lines_.place());
    const std::string place_of_keys = lines_.place();
    for (std::size_t i = 0; i < n; ++i) {
      const std::string particle = next_line(fmt::format("particle {} of {}", i, n));
      table.add(words_of(particle), lines_.place());
    }
    frame = table.frame(place);
    complete(frame, keys, table.has("angle"), place_of_keys);
    return true;
  }

 private:
  std::string next_line(const std::string& what) {
    std::string line;
    if (!lines_.next(line))
      throw FileError(fmt::format("{}: the file ends before {}", lines_.place(), what));
    return line;
  }

  static std::string value(const Keys& keys, const std::string& key) {
    const auto found = keys.find(key);
    return found == keys.end() ? "" : found->second;
  }

  static void complete(ForeignFrame& frame, const Keys& keys, bool has_angle,
                       const std::string& place);

  TextLines lines_;
};

bool is_false(std::string_view word) {
  return word == "F" || word == "0" || word == "False";
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

/// The height of a plane does not matter.
void move_to_zero_height(ForeignFrame& frame) {
  const auto height = [](const Vec3& position) { return position[2]; };
  if (std::ranges::adjacent_find(frame.position, std::ranges::not_equal_to(), height) !=
      frame.position.end())
    return;
  for (Vec3& position : frame.position) position[2] = 0;
}

void XyzFrames::complete(ForeignFrame& frame, const Keys& keys, bool has_angle,
                         const std::string& place) {
  set_box(frame, keys, place);
  const std::string pbc = value(keys, "pbc");
  const std::vector<std::string_view> periodic = words_of(pbc);
  const bool is_plane = has_angle || (periodic.size() == 3 && is_false(periodic[2]));
  // All programs write three coordinates.
  frame.dimension = is_plane ? std::optional(2) : std::nullopt;
  if (is_plane) move_to_zero_height(frame);
  if (const auto time = keys.find("time"); time != keys.end())
    frame.time = parsed<double>(time->second, "Time", place);
  for (const char* key : {"step", "timestep"})
    if (const auto step = keys.find(key); step != keys.end())
      frame.step = parsed<std::int64_t>(step->second, "Step", place);
}

}  // namespace

std::unique_ptr<ForeignFrames> open_xyz(const fs::path& path) {
  return std::make_unique<XyzFrames>(path);
}

}  // namespace vitrel
