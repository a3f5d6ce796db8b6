#include "core/io/foreign/xyz_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/io/foreign/particle_table.h"
#include "core/io/foreign/text_lines.h"
#include "core/tolerances.h"

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

/// Where the value that begins at `begin` ends: behind its quotes or brackets, or at the next blank.
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

/// key=value, key="several words" and key=[[lists], [of, lists]], with blanks around = or none; words without = are
/// skipped.
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

  const char* box_crossings() const override { return "property map_shift"; }

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

/// Whether a word of `pbc` says that the box is periodic; nothing if it says neither.
std::optional<bool> periodicity(std::string_view word) {
  if (word == "t" || word == "true" || word == "1") return true;
  if (word == "f" || word == "false" || word == "0") return false;
  return std::nullopt;
}

/// Whether the box is periodic along z, as it must be along x and y.
bool is_periodic_along_z(const Keys& keys, const std::string& place) {
  const auto pbc = keys.find("pbc");
  if (pbc == keys.end()) return true;
  const std::string text = lower_case(pbc->second);
  const std::vector<std::string_view> words = words_of(text, " \t,[]{}");
  if (words.size() != 3 || !std::ranges::all_of(words, [](std::string_view word) {
        return periodicity(word).has_value();
      }))
    throw FileError(fmt::format("{}: pbc is \"{}\", but should be T or F for each of x, y and z",
                                place, pbc->second));
  for (std::size_t k = 0; k < 2; ++k)
    if (!*periodicity(words[k]))
      throw FileError(
          fmt::format("{}: pbc=\"{}\" says that the box is not periodic along {}, but vitrel's "
                      "boxes are; only a plane needs no period along z",
                      place, pbc->second, "xyz"[k]));
  return *periodicity(words[2]);
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
void move_to_zero_height(ForeignFrame& frame, const char* because, const std::string& place) {
  if (frame.position.empty()) return;
  const auto height = [](const Vec3& position) { return position[2]; };
  const auto [lowest, highest] = std::ranges::minmax(frame.position, {}, height);
  const double wide = frame.box ? frame.box->x() : 1;
  if (highest[2] - lowest[2] > tolerance::flat * wide)
    throw FileError(fmt::format(
        "{}: {}, but the heights of particles differ by {}; in a plane all are the same", place,
        because, highest[2] - lowest[2]));
  for (Vec3& position : frame.position) position[2] = 0;
}

void XyzFrames::complete(ForeignFrame& frame, const Keys& keys, bool has_angle,
                         const std::string& place) {
  set_box(frame, keys, place);
  const bool is_flat = !is_periodic_along_z(keys, place), is_plane = is_flat || has_angle;
  // All programs write three coordinates.
  frame.dimension = is_plane ? std::optional(2) : std::nullopt;
  if (is_plane)
    move_to_zero_height(
        frame, is_flat ? "the box is not periodic along z" : "particles have an angle", place);
  if (const auto time = keys.find("time"); time != keys.end())
    frame.time = real_number(time->second, "Time", place);
  for (const char* key : {"step", "timestep"})
    if (const auto step = keys.find(key); step != keys.end())
      frame.step = parsed<std::int64_t>(step->second, "Step", place);
}

}  // namespace

std::unique_ptr<ForeignFrames> open_xyz(const fs::path& path) {
  return std::make_unique<XyzFrames>(path);
}

}  // namespace vitrel
