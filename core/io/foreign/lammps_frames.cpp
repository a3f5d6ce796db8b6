#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.h"
#include "core/geometry/ellipsoid.h"
#include "core/io/box_crossings.h"
#include "core/io/foreign/foreign_formats.h"
#include "core/io/foreign/particle_table.h"
#include "core/io/foreign/text_lines.h"
#include "core/whole_number.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

/// What LAMMPS calls the columns of a particle table (particle_table.h). Shapes are whole axes.
const std::map<std::string, std::string> table_names = {{"id", "id"},
                                                        {"type", "species"},
                                                        {"xu", "unwrapped_x"},
                                                        {"yu", "unwrapped_y"},
                                                        {"zu", "unwrapped_z"},
                                                        {"ix", "image_x"},
                                                        {"iy", "image_y"},
                                                        {"iz", "image_z"},
                                                        {"x", "x"},
                                                        {"y", "y"},
                                                        {"z", "z"},
                                                        {"vx", "vx"},
                                                        {"vy", "vy"},
                                                        {"vz", "vz"},
                                                        {"mass", "mass"},
                                                        {"radius", "radius"},
                                                        {"diameter", "diameter"},
                                                        {"shapex", "diameter_x"},
                                                        {"shapey", "diameter_y"},
                                                        {"shapez", "diameter_z"},
                                                        {"quatw", "qw"},
                                                        {"quati", "qx"},
                                                        {"quatj", "qy"},
                                                        {"quatk", "qz"},
                                                        {"omegax", "omega_x"},
                                                        {"omegay", "omega_y"},
                                                        {"omegaz", "omega_z"}};
/// Columns in fractions of the box.
const std::map<std::string, std::string> scaled_names = {
    {"xs", "x"},           {"ys", "y"}, {"zs", "z"}, {"xsu", "unwrapped_x"}, {"ysu", "unwrapped_y"},
    {"zsu", "unwrapped_z"}};

/// The edges of a cuboid, in the order of the file.
struct Bounds {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();

  Vec3 lengths() const { return high - low; }
  Vec3 centre() const { return 0.5 * (low + high); }
};

class LammpsFile {
 public:
  explicit LammpsFile(const fs::path& path) : lines_(path) {}

 protected:
  [[noreturn]] void fail(const std::string& what) const {
    throw FileError(fmt::format("{}: {}", lines_.place(), what));
  }

  double number(std::string_view text, const char* what) const {
    const std::optional<double> value = number_in(text);
    if (!value || !std::isfinite(*value))
      fail(fmt::format("{} is \"{}\", but should be a number", what, text));
    return *value;
  }

  template <class Whole>
  Whole whole(std::string_view text, const char* what) const {
    const auto value = whole_number<Whole>(number(text, what));
    if (!value) fail(fmt::format("{} is \"{}\", but should be a whole number", what, text));
    return *value;
  }

  TextLines lines_;
};

class DumpFrames final : public ForeignFrames, LammpsFile {
 public:
  DumpFrames(const fs::path& path, const ImportOptions& options)
      : LammpsFile(path), renamed_(options.columns) {}

  bool next(ForeignFrame& frame) override {
    frame = {};
    std::optional<std::size_t> particles;
    std::optional<Bounds> bounds;
    std::string line;
    while (lines_.next(line)) {
      if (trimmed(line).empty()) continue;
      if (!line.starts_with("ITEM: ")) fail("should be a line with ITEM:");
      const std::string item(trimmed(std::string_view(line).substr(6)));
      if (item == "TIMESTEP")
        frame.step = whole<std::int64_t>(value("the step"), "the step");
      else if (item == "TIME")
        frame.time = number(value("the time"), "the time");
      else if (item == "UNITS")
        unit_style_ = value("the units");
      else if (item == "NUMBER OF ATOMS")
        particles = whole<std::size_t>(value("the number of atoms"), "the number of atoms");
      else if (item.starts_with("BOX BOUNDS"))
        bounds = read_bounds(item, frame);
      else if (item.starts_with("ATOMS"))
        return read_atoms(item, particles, bounds, frame);
      else
        fail(fmt::format("\"{}\" is no item of a dump that can be read", item));
    }
    if (particles || bounds || frame.step) fail("the file ends before ITEM: ATOMS");
    return false;
  }

 private:
  std::string value(const char* what) {
    std::string line;
    if (!lines_.next(line)) fail(fmt::format("the file ends before {}", what));
    return std::string(trimmed(line));
  }

  Bounds read_bounds(const std::string& item, ForeignFrame& frame) {
    if (item.find("xy xz yz") != std::string::npos || item.find("abc") != std::string::npos)
      fail("the box is tilted, but should be a cuboid with edges along x, y and z");
    const std::vector<std::string_view> words = words_of(item);
    if (words.size() == 5) {
      std::array<bool, 3> periodic;
      for (std::size_t k = 0; k < 3; ++k) periodic[k] = words[k + 2] == "pp";
      frame.dimension = with_place(lines_.place(), [&] {
        return dimension_of_boundaries(
            periodic, fmt::format("BOX BOUNDS {} {} {}", words[2], words[3], words[4]));
      });
    } else {
      frame.assumed["boundaries"] = "periodic";
    }
    Bounds bounds;
    for (int k = 0; k < 3; ++k) {
      const std::string line = value("the box");
      const std::vector<std::string_view> ends = words_of(line);
      if (ends.size() != 2) fail("should be the lower and the upper end of the box");
      bounds.low[k] = number(ends[0], "an end of the box");
      bounds.high[k] = number(ends[1], "an end of the box");
    }
    frame.box = bounds.lengths();
    return bounds;
  }

  bool read_atoms(const std::string& item, const std::optional<std::size_t>& particles,
                  const std::optional<Bounds>& bounds, ForeignFrame& frame) {
    if (!particles) fail("there is no ITEM: NUMBER OF ATOMS before");
    if (!bounds) fail("there is no ITEM: BOX BOUNDS before");
    const std::string place = lines_.place();
    std::vector<std::string> names;
    const std::vector<std::string_view> words = words_of(item);
    names.assign(words.begin() + 1, words.end());
    std::array<bool, 2> scaled{};
    ParticleTable table(columns(names, scaled), place, renamed_);
    for (std::size_t i = 0; i < *particles; ++i) {
      std::string line;
      if (!lines_.next(line))
        fail(fmt::format("the file ends before atom {} of {}", i + 1, *particles));
      table.add(words_of(line), lines_.place());
    }
    ForeignFrame atoms = table.frame(place);
    atoms.dimension = frame.dimension;
    atoms.step = frame.step;
    atoms.time = frame.time;
    atoms.box = frame.box;
    atoms.assumed.merge(frame.assumed);
    place_in_box(atoms.position, scaled[0], *bounds);
    place_in_box(atoms.unwrapped, scaled[1], *bounds);
    if (!unit_style_.empty() && unit_style_ != "lj")
      atoms.skipped.insert("units " + unit_style_ + ", as all numbers are taken as they are");
    frame = std::move(atoms);
    return true;
  }

  /// Returns the names of the table. `scaled` says whether positions and unwrapped positions are fractions of the box.
  static std::vector<std::string> columns(const std::vector<std::string>& names,
                                          std::array<bool, 2>& scaled) {
    const auto has = [&](const std::string& name) {
      return std::ranges::find(names, name) != names.end();
    };
    scaled = {has("xs") && !has("x"), has("xsu") && !has("xu")};
    std::vector<std::string> result;
    for (const std::string& name : names) {
      const auto plain = table_names.find(name);
      const auto fraction = scaled_names.find(name);
      const bool is_used = fraction != scaled_names.end() &&
                           scaled[fraction->second.starts_with("unwrapped") ? 1 : 0];
      if (name == "element" && !has("type"))
        result.emplace_back("species");
      else if (plain != table_names.end())
        result.push_back(plain->second);
      else
        result.push_back(is_used ? fraction->second : name);
    }
    return result;
  }

  static void place_in_box(std::vector<Vec3>& positions, bool scaled, const Bounds& bounds) {
    for (Vec3& position : positions)
      position = scaled ? Vec3((position - Vec3::Constant(0.5)).cwiseProduct(bounds.lengths()))
                        : Vec3(position - bounds.centre());
  }

  std::vector<ImportOptions::Column> renamed_;
  std::string unit_style_;
};

/// The columns of "Atoms # style"; images may follow them.
const std::map<std::string, std::vector<std::string>> style_columns = {
    {"atomic", {"id", "type", "x", "y", "z"}},
    {"charge", {"id", "type", "q", "x", "y", "z"}},
    {"bond", {"id", "mol", "type", "x", "y", "z"}},
    {"angle", {"id", "mol", "type", "x", "y", "z"}},
    {"molecular", {"id", "mol", "type", "x", "y", "z"}},
    {"full", {"id", "mol", "type", "q", "x", "y", "z"}},
    {"sphere", {"id", "type", "diameter", "density", "x", "y", "z"}},
    {"ellipsoid", {"id", "type", "ellipsoidflag", "density", "x", "y", "z"}}};

class DataFrames final : public ForeignFrames, LammpsFile {
 public:
  explicit DataFrames(const fs::path& path) : LammpsFile(path) {}

  bool next(ForeignFrame& frame) override {
    if (is_read_) return false;
    is_read_ = true;
    read_header();
    std::string style;
    while (!section_.empty()) {
      const std::string section = section_;
      const std::string name(trimmed(std::string_view(section).substr(0, section.find('#'))));
      if (name == "Atoms") style = style_of(section);
      read_section(name);
    }
    if (style.empty()) fail("has no section Atoms");
    frame = {};
    frame.box = bounds_.lengths();
    frame.assumed["boundaries"] = "periodic, which this format cannot state";
    fill(frame, style);
    return true;
  }

 private:
  using Rows = std::map<double, std::vector<double>>;  ///< rows by id, or by type

  /// Reads the next line of a section, or of the header, without its comment. Returns false at the name of a section,
  /// which is kept, and at the end of the file.
  bool next_row(std::string& row) {
    std::string line;
    section_.clear();
    while (lines_.next(line)) {
      row = trimmed(std::string_view(line).substr(0, line.find('#')));
      if (row.empty()) continue;
      if (number_in(words_of(row)[0])) return true;
      section_ = trimmed(line);
      return false;
    }
    return false;
  }

  /// Reads the header up to the name of the first section.
  void read_header() {
    std::string row;
    lines_.next(row);  // a title
    while (next_row(row)) {
      const std::vector<std::string_view> words = words_of(row);
      const std::string_view key = words.back();
      if (key == "atoms") particles_ = whole<std::size_t>(words[0], "the number of atoms");
      if (key == "yz") {
        for (int k = 0; k < 3; ++k)
          if (number(words[static_cast<std::size_t>(k)], "a tilt") != 0)
            fail("the box is tilted, but should be a cuboid with edges along x, y and z");
      }
      for (int k = 0; k < 3; ++k)
        if (key == fmt::format("{}hi", "xyz"[k])) {
          bounds_.low[k] = number(words[0], "an end of the box");
          bounds_.high[k] = number(words[1], "an end of the box");
        }
    }
    if (section_.empty()) fail("the file ends before the section Atoms");
  }

  /// Reads rows of numbers up to the next section.
  void read_section(const std::string& name) {
    Rows& rows = sections_[name];
    std::string row;
    while (next_row(row)) {
      std::vector<double> numbers;
      for (const std::string_view word : words_of(row))
        numbers.push_back(number_in(word).value_or(std::nan("")));
      if (!rows.emplace(numbers[0], numbers).second)
        fail(fmt::format("{} comes twice in the section {}", numbers[0], name));
    }
  }

  std::string style_of(const std::string& section) const {
    const std::size_t mark = section.find('#');
    const std::string style(mark == std::string::npos
                                ? std::string_view()
                                : trimmed(std::string_view(section).substr(mark + 1)));
    std::string known;
    for (const auto& [name, columns] : style_columns) known += (known.empty() ? "" : ", ") + name;
    if (!style_columns.contains(style))
      fail(fmt::format(
          "the section Atoms should name its style, as in \"Atoms # sphere\": one of {}", known));
    return style;
  }

  /// Returns the row of an atom in another section, which must have at least `least` numbers.
  const std::vector<double>* row(const char* section, double id, std::size_t least) const {
    const auto rows = sections_.find(section);
    if (rows == sections_.end()) return nullptr;
    const auto found = rows->second.find(id);
    if (found == rows->second.end() || found->second.size() < least)
      fail(fmt::format("the section {} has no line with {} numbers for {}", section, least, id));
    return &found->second;
  }

  void fill(ForeignFrame& frame, const std::string& style) {
    const std::vector<std::string>& columns = style_columns.at(style);
    const Rows& atoms = sections_.at("Atoms");
    if (atoms.size() != particles_)
      fail(fmt::format("the section Atoms has {} lines, but there are {} atoms", atoms.size(),
                       particles_));
    const auto place = [&](const char* name) {
      return static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin());
    };
    for (const auto& [id, numbers] : atoms) {
      const std::size_t count = numbers.size();
      if (count != columns.size() && count != columns.size() + 3)
        fail(fmt::format("atom {} has {} numbers, but should have {}, and perhaps three images", id,
                         count, columns.size()));
      if (!std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }))
        fail(fmt::format("atom {} has something else than numbers", id));
      frame.id.push_back(id);
      frame.position.push_back(Vec3(&numbers[place("x")]) - bounds_.centre());
      if (count > columns.size()) {
        const auto image = box_crossings<3>(Vec3(&numbers[columns.size()]));
        if (!image)
          fail(fmt::format("atom {} has the images {:g}, which should be whole numbers of boxes",
                           id, fmt::join(numbers.end() - 3, numbers.end(), ", ")));
        frame.image.push_back(*image);
      }
      const double type = numbers[place("type")];
      frame.species.push_back(fmt::format("{:g}", type));
      if (style == "sphere")
        add_sphere(frame, numbers[place("diameter")], numbers[place("density")]);
      else if (style == "ellipsoid")
        add_ellipsoid(frame, id, numbers[place("ellipsoidflag")] != 0, numbers[place("density")]);
      else if (const auto* mass = row("Masses", type, 2))
        frame.mass.push_back((*mass)[1]);
      add_velocity(frame, id, style);
    }
    for (const auto& [name, rows] : sections_)
      if (name != "Atoms" && name != "Masses" && name != "Velocities" && name != "Ellipsoids")
        frame.skipped.insert(name);
  }

  static double volume(const Vec3& axes) { return 4 * std::numbers::pi / 3 * prod(axes); }

  void add_sphere(ForeignFrame& frame, double diameter, double density) const {
    if (diameter == 0) fail("points, of diameter 0, have no size");
    const Vec3 axes = Vec3::Constant(0.5 * diameter);
    frame.half_lengths.push_back(axes);
    frame.mass.push_back(density * volume(axes));
  }

  void add_ellipsoid(ForeignFrame& frame, double id, bool is_ellipsoid, double density) const {
    const std::vector<double>* const shape = is_ellipsoid ? row("Ellipsoids", id, 8) : nullptr;
    if (!shape) fail(fmt::format("atom {} is a point and has no size", id));
    const Vec3 axes = 0.5 * Vec3(&(*shape)[1]);
    frame.half_lengths.push_back(axes);
    frame.orientation.emplace_back((*shape)[4], (*shape)[5], (*shape)[6], (*shape)[7]);
    frame.mass.push_back(density * volume(axes));
  }

  /// Adds the velocities of an atom. A line of Velocities ends with ω for spheres and with the angular momentum for
  /// ellipsoids, both in the axes of space.
  void add_velocity(ForeignFrame& frame, double id, const std::string& style) const {
    const bool rotates = style == "sphere" || style == "ellipsoid";
    const std::vector<double>* const numbers = row("Velocities", id, rotates ? 7 : 4);
    if (!numbers) return;
    frame.velocity.push_back(Vec3(&(*numbers)[1]));
    if (!rotates) return;
    const Vec3 rotation(&(*numbers)[4]);
    if (style == "sphere") {
      frame.angular_velocity.push_back(rotation);
      return;
    }
    const Quaternion& q = frame.orientation.back();
    const Vec3 inertia =
        frame.mass.back() * Ellipsoid{frame.half_lengths.back()}.full_inertia_per_mass();
    const Vec3 momentum = q.conjugate() * rotation;
    frame.angular_velocity.push_back(q * Vec3(momentum.cwiseQuotient(inertia)));
  }

  bool is_read_ = false;
  std::string section_;  ///< the line with the name of the next section
  std::size_t particles_ = 0;
  Bounds bounds_;
  std::map<std::string, Rows> sections_;
};

/// Returns whether a line near the beginning is a number of atoms.
bool is_data(std::string_view start) {
  if (start.find('\0') != std::string_view::npos) return false;
  while (!start.empty()) {
    const std::string_view line = start.substr(0, start.find('\n'));
    const std::vector<std::string_view> words = words_of(line, " \t\r");
    if (words.size() >= 2 && words[1] == "atoms" && number_in(words[0])) return true;
    start.remove_prefix(std::min(line.size() + 1, start.size()));
  }
  return false;
}

}  // namespace

constexpr ForeignFormat lammps_dump_format = {
    "LAMMPS dump",
    {"ITEM: BOX BOUNDS", "BOX BOUNDS pp pp ff, or import.dimension = 2",
     "columns radius, diameter, or shapex, shapey and shapez", "columns ix, iy, iz or xu, yu, zu"},
    [](std::string_view start) { return start.starts_with("ITEM:"); },
    [](const fs::path& path, const ImportOptions& options) -> std::unique_ptr<ForeignFrames> {
      return std::make_unique<DumpFrames>(path, options);
    }};

constexpr ForeignFormat lammps_data_format = {
    "LAMMPS data",
    {"xlo xhi, ylo yhi and zlo zhi", "import.dimension = 2",
     "atom style sphere or ellipsoid with the section Ellipsoids", "images behind the positions"},
    is_data,
    [](const fs::path& path, const ImportOptions&) -> std::unique_ptr<ForeignFrames> {
      return std::make_unique<DataFrames>(path);
    }};

}  // namespace vitrel
