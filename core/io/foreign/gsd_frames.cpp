#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/io/box_crossings.h"
#include "core/io/foreign/foreign_formats.h"
#include "core/io/foreign/gsd_layout.h"
#include "core/io/json.h"

namespace vitrel {
namespace {

/// Returns the number of bytes of a number of this type; 0 if there is no such type.
std::uint64_t width_of(std::uint8_t type) {
  constexpr std::array<std::uint64_t, 11> widths = {0, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8};
  return type < widths.size() ? widths[type] : type == 11 ? 1 : 0;
}

template <class T>
void append_as(std::vector<double>& values, const std::vector<std::byte>& bytes) {
  for (std::size_t k = 0; k < bytes.size(); k += sizeof(T)) {
    T number;
    std::memcpy(&number, &bytes[k], sizeof(T));
    values.push_back(static_cast<double>(number));
  }
}

std::vector<double> numbers(std::uint8_t type, const std::vector<std::byte>& bytes) {
  std::vector<double> values;
  if (type == 1 || type == 11) append_as<std::uint8_t>(values, bytes);
  if (type == 2) append_as<std::uint16_t>(values, bytes);
  if (type == 3) append_as<std::uint32_t>(values, bytes);
  if (type == 4) append_as<std::uint64_t>(values, bytes);
  if (type == 5) append_as<std::int8_t>(values, bytes);
  if (type == 6) append_as<std::int16_t>(values, bytes);
  if (type == 7) append_as<std::int32_t>(values, bytes);
  if (type == 8) append_as<std::int64_t>(values, bytes);
  if (type == 9) append_as<float>(values, bytes);
  if (type == 10) append_as<double>(values, bytes);
  return values;
}

/// Returns the text before the first zero byte.
std::string text_of(const char* bytes, std::size_t most) {
  return {bytes, std::find(bytes, bytes + most, '\0')};
}

/// Reads the named arrays ("chunks") of a GSD file, file layers 1 and 2, of any schema. Throws FileError, also for
/// sizes and places that do not fit into the file.
class GsdReader {
 public:
  explicit GsdReader(const std::filesystem::path& path)
      : path_(path.string()), stream_(path, std::ios::binary | std::ios::ate) {
    if (!stream_)
      throw FileError(fmt::format("{}: cannot open the file: {}", path_, std::strerror(errno)));
    size_ = static_cast<std::uint64_t>(stream_.tellg());
    gsd::Header header;
    read_bytes(0, sizeof(header), &header);
    if (header.magic != gsd::magic) fail("is no GSD file");
    const std::uint32_t layer = header.version >> 16;
    if (layer != 1 && layer != 2)
      fail(fmt::format("has the file layer {}, but 1 and 2 can be read", layer));
    schema_ = text_of(header.schema.data(), header.schema.size());
    if (header.names_units > size_ / gsd::names_unit)
      fail("is damaged: its names do not fit into it");
    read_names(header.names_location, header.names_units * gsd::names_unit, layer == 1);
    read_index(header.index_location, header.index_entries);
  }

  std::uint64_t frames() const { return frames_; }
  const std::string& schema() const { return schema_; }
  const std::string& path() const { return path_; }

  struct Chunk {
    std::uint64_t rows = 0;
    std::uint32_t columns = 0;
    std::vector<double> values;  ///< row by row
  };
  /// Returns the chunk of the frame, or else that of the first frame; without rows if neither has it.
  GsdReader::Chunk read(const std::string& name, std::uint64_t frame) {
    const gsd::Entry* entry = find(name, frame);
    if (!entry) return {};
    return {entry->rows, entry->columns, numbers(entry->type, bytes_of(*entry))};
  }
  /// Returns whether a frame after the first has the chunk.
  bool is_in_later_frames(const std::string& name) const {
    const auto after_first = index_.upper_bound({name, 0});
    return after_first != index_.end() && after_first->first.first == name;
  }
  /// Returns whether any frame has the chunk.
  bool has(const std::string& name) const { return find(name, 0) || is_in_later_frames(name); }
  /// The names of all chunks.
  const std::vector<std::string>& names() const { return names_; }
  /// Returns the rows of a chunk of texts.
  std::vector<std::string> read_texts(const std::string& name, std::uint64_t frame) {
    const gsd::Entry* entry = find(name, frame);
    if (!entry) return {};
    const std::vector<std::byte> bytes = bytes_of(*entry);
    const std::size_t width = entry->columns * width_of(entry->type);
    std::vector<std::string> texts;
    for (std::size_t k = 0; k < bytes.size(); k += width)
      texts.push_back(text_of(reinterpret_cast<const char*>(&bytes[k]), width));
    return texts;
  }

  [[noreturn]] void fail(const std::string& what) const { throw FileError(path_ + ": " + what); }

 private:
  void read_bytes(std::uint64_t offset, std::uint64_t count, void* out) {
    if (count > size_ || offset > size_ - count) fail("is truncated or damaged");
    if (count == 0) return;
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(static_cast<char*>(out), static_cast<std::streamsize>(count));
    if (!stream_) fail("cannot be read");
  }
  /// Reads names of fixed width, or names one behind the other, up to an empty one.
  void read_names(std::uint64_t location, std::uint64_t bytes, bool fixed_width) {
    std::string block(bytes, '\0');
    read_bytes(location, bytes, block.data());
    for (std::size_t k = 0; k < block.size();) {
      const std::string name =
          text_of(&block[k], fixed_width ? std::size_t{gsd::names_unit} : block.size() - k);
      if (name.empty()) break;
      names_.push_back(name);
      k += fixed_width ? gsd::names_unit : name.size() + 1;
    }
  }
  /// Reads the index up to an entry without a place.
  void read_index(std::uint64_t location, std::uint64_t entries) {
    if (entries > size_ / sizeof(gsd::Entry)) fail("is damaged: its index does not fit into it");
    std::vector<gsd::Entry> index(entries);
    read_bytes(location, entries * sizeof(gsd::Entry), index.data());
    for (const gsd::Entry& entry : index) {
      if (entry.location == 0) break;
      if (entry.name >= names_.size() || entry.frame > entries)
        fail("is damaged: its index has an impossible entry");
      frames_ = std::max(frames_, entry.frame + 1);
      index_[{names_[entry.name], entry.frame}] = entry;
    }
  }
  const gsd::Entry* find(const std::string& name, std::uint64_t frame) const {
    for (const std::uint64_t place : {frame, std::uint64_t{0}})
      if (const auto found = index_.find({name, place}); found != index_.end())
        return &found->second;
    return nullptr;
  }
  std::vector<std::byte> bytes_of(const gsd::Entry& entry) {
    const std::uint64_t width = width_of(entry.type);
    const bool is_impossible = width == 0 || entry.columns == 0 || entry.location < 0 ||
                               entry.rows > size_ / width / entry.columns;
    if (is_impossible)
      fail(fmt::format("frame {}, {}: is damaged", entry.frame, names_[entry.name]));
    std::vector<std::byte> bytes(entry.rows * entry.columns * width);
    read_bytes(static_cast<std::uint64_t>(entry.location), bytes.size(), bytes.data());
    return bytes;
  }

  std::string path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0, frames_ = 0;
  std::string schema_;
  std::vector<std::string> names_;
  std::map<std::pair<std::string, std::uint64_t>, gsd::Entry> index_;
};

/// Returns the name of the species that a type "A#2" is a part of, in files of earlier versions of vitrel.
std::string species_of(const std::string& type) {
  const std::size_t mark = type.rfind('#');
  const bool is_part = mark != std::string::npos && mark + 1 < type.size() &&
                       std::all_of(type.begin() + static_cast<std::ptrdiff_t>(mark) + 1, type.end(),
                                   [](char c) { return c >= '0' && c <= '9'; });
  return is_part ? type.substr(0, mark) : type;
}

/// The chunks that are read.
const std::set<std::string> known_chunks = {"configuration/step",
                                            "configuration/dimensions",
                                            "configuration/box",
                                            "log/time",
                                            "particles/N",
                                            "particles/types",
                                            "particles/typeid",
                                            "particles/type_shapes",
                                            "particles/diameter",
                                            "log/particles/semiaxes",
                                            "particles/position",
                                            "particles/orientation",
                                            "particles/image",
                                            "particles/mass",
                                            "particles/moment_inertia",
                                            "particles/velocity",
                                            "particles/angmom"};

class GsdFrames final : public ForeignFrames {
 public:
  explicit GsdFrames(const std::filesystem::path& path) : file_(path) {
    if (file_.schema() != "hoomd")
      file_.fail(fmt::format("has the schema \"{}\", but should have that of HOOMD-blue, \"hoomd\"",
                             file_.schema()));
  }

  bool next(ForeignFrame& frame) override {
    if (number_ == file_.frames()) return false;
    frame = {};
    particles_ = static_cast<std::size_t>(number("particles/N", 0));
    frame.dimension = static_cast<int>(number("configuration/dimensions", 3));
    if (is_absent("configuration/dimensions"))
      frame.assumed["dimension"] = "3, the default of configuration/dimensions";
    if (const char* steps = "configuration/step"; file_.frames() == 1 || file_.has(steps))
      frame.step = static_cast<std::int64_t>(number(steps, 0));
    if (const auto time = file_.read("log/time", number_); time.rows > 0)
      frame.time = time.values[0];
    set_box(frame);
    set_places(frame);
    set_types(frame);
    frame.mass = column("particles/mass", 1);
    if (is_absent("particles/mass")) frame.assumed["masses"] = "1, the default of particles/mass";
    frame.velocity = vectors("particles/velocity");
    if (frame.velocity.empty() && file_.has("particles/velocity")) {
      frame.velocity.assign(particles_, Vec3::Zero());
      frame.assumed["velocities"] = "0, the default of particles/velocity";
    }
    set_angular_velocities(frame);
    std::ranges::copy_if(file_.names(), std::inserter(frame.skipped, frame.skipped.end()),
                         [](const std::string& name) { return !known_chunks.contains(name); });
    ++number_;
    return true;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    file_.fail(fmt::format("frame {}: {}", number_, what));
  }

  double number(const std::string& name, double otherwise) {
    const GsdReader::Chunk chunk = file_.read(name, number_);
    const double value = chunk.rows > 0 ? chunk.values[0] : otherwise;
    if (!(value >= 0 && value < 9e15)) fail(fmt::format("{} is {}", name, value));
    return value;
  }

  /// Returns a row per particle; empty if the chunk is not there.
  std::vector<double> rows(const std::string& name, std::uint32_t columns) {
    GsdReader::Chunk chunk = file_.read(name, number_);
    if (chunk.rows == 0) return {};
    if (chunk.rows != particles_ || chunk.columns != columns)
      fail(fmt::format("{} has {} rows of {}, but should have {} of {}", name, chunk.rows,
                       chunk.columns, particles_, columns));
    return std::move(chunk.values);
  }

  std::vector<double> column(const std::string& name, double otherwise) {
    std::vector<double> values = rows(name, 1);
    if (values.empty()) values.assign(particles_, otherwise);
    return values;
  }

  bool is_absent(const std::string& name) { return file_.read(name, number_).rows == 0; }

  std::vector<Vec3> vectors(const std::string& name) {
    const std::vector<double> values = rows(name, 3);
    std::vector<Vec3> result;
    for (std::size_t k = 0; k < values.size(); k += 3) result.emplace_back(&values[k]);
    return result;
  }

  std::vector<Quaternion> quaternions(const std::string& name) {
    const std::vector<double> v = rows(name, 4);
    std::vector<Quaternion> result;
    for (std::size_t k = 0; k < v.size(); k += 4)
      result.emplace_back(v[k], v[k + 1], v[k + 2], v[k + 3]);
    return result;
  }

  void set_box(ForeignFrame& frame) {
    const GsdReader::Chunk box = file_.read("configuration/box", number_);
    if (box.values.size() != 6) fail("configuration/box should have six numbers");
    if (box.values[3] != 0 || box.values[4] != 0 || box.values[5] != 0)
      fail("the box should be a cuboid with edges along x, y and z");
    frame.box = Vec3(box.values.data());
  }

  void set_places(ForeignFrame& frame) {
    frame.position = vectors("particles/position");
    // This also ensures that what the schema supplies for so many particles fits into the memory.
    if (frame.position.size() != particles_)
      fail("particles/position should have a row for each of the particles/N particles");
    frame.orientation = quaternions("particles/orientation");
    if (frame.orientation.empty()) {
      frame.orientation.assign(particles_, Quaternion::Identity());
      frame.assumed["orientations"] = "not turned, the default of particles/orientation";
    }
    set_images(frame);
  }

  /// Many programs write images into the first frame only, or not at all. The images of later frames are then unknown,
  /// rather than the same.
  void set_images(ForeignFrame& frame) {
    if (file_.frames() > 1 && !file_.is_in_later_frames("particles/image")) return;
    for (const Vec3& image : vectors("particles/image")) {
      const auto crossings = box_crossings<3>(image);
      if (!crossings) fail("particles/image has impossible numbers");
      frame.image.push_back(*crossings);
    }
    if (!frame.image.empty()) return;
    frame.image.assign(particles_, Shift<3>::Zero());
    frame.assumed["box crossings"] = "0, the default of particles/image";
  }

  void set_types(ForeignFrame& frame) {
    std::vector<std::string> types = file_.read_texts("particles/types", number_);
    if (types.empty()) {
      types = {"A"};
      frame.assumed["species"] = "all are \"A\", the default of particles/types";
    }
    const std::vector<std::optional<Vec3>> shapes = shapes_of(types.size());
    const std::vector<double> diameters = rows("particles/diameter", 1);
    const std::vector<Vec3> own = vectors("log/particles/semiaxes");
    std::size_t without_shape = 0;
    if (types.size() > 1 && is_absent("particles/typeid"))
      frame.assumed["species"] = types.front() + ", the default of particles/typeid";
    for (const double type : column("particles/typeid", 0)) {
      if (!(type >= 0 && type < static_cast<double>(types.size())))
        fail(fmt::format("particles/typeid has the type {}, but there are {}", type, types.size()));
      const auto k = static_cast<std::size_t>(type);
      frame.species.push_back(species_of(types[k]));
      const std::size_t i = frame.half_lengths.size();
      if (!shapes.empty() && shapes[k]) {
        frame.half_lengths.push_back(*shapes[k]);
      } else if (!own.empty()) {
        frame.half_lengths.push_back(own[i]);
      } else {
        frame.half_lengths.push_back(Vec3::Constant(i < diameters.size() ? 0.5 * diameters[i] : 0));
        ++without_shape;
      }
    }
    if (without_shape > 0 && diameters.empty()) frame.half_lengths.clear();
    if (without_shape == 0 && !diameters.empty())
      frame.skipped.insert("particles/diameter, as the shapes say more");
  }

  /// Returns the semi-axes of every type that has a shape; empty if the file does not have any.
  std::vector<std::optional<Vec3>> shapes_of(std::size_t types) {
    const std::vector<std::string> texts = file_.read_texts("particles/type_shapes", number_);
    if (texts.empty() || texts.front().empty()) return {};
    if (texts.size() != types) fail("particles/type_shapes should have a shape per type");
    std::vector<std::optional<Vec3>> shapes;
    for (const std::string& text : texts)
      shapes.push_back(text == "{}" ? std::nullopt : std::optional(shape_of(text)));
    return shapes;
  }

  Vec3 shape_of(const std::string& text) const {
    const Json shape = Json::parse(text, nullptr, false);
    const auto length = [&](const char* key) {
      const bool is_there = shape.is_object() && shape.contains(key) && shape[key].is_number();
      if (!is_there)
        fail(fmt::format(
            "particles/type_shapes has {}, but should have ellipsoids, spheres or disks", text));
      return shape[key].get<double>();
    };
    const bool is_ellipsoid =
        shape.is_object() && shape.contains("type") && shape["type"] == "Ellipsoid";
    return is_ellipsoid ? Vec3(length("a"), length("b"), length("c"))
                        : Vec3::Constant(0.5 * length("diameter"));
  }

  /// The angular momentum L is stored as 2 q (0, L); L and the moments are along the particle's own axes. A moment of 0
  /// means that the rotation is not modelled. Spheroids written by vitrel have it about their axis, where ω = L/I⊥.
  void set_angular_velocities(ForeignFrame& frame) {
    std::vector<Quaternion> momenta = quaternions("particles/angmom");
    const bool is_default = momenta.empty() && file_.has("particles/angmom");
    if (is_default) momenta.assign(particles_, Quaternion(0, 0, 0, 0));
    const std::vector<Vec3> inertias = vectors("particles/moment_inertia");
    if (momenta.empty() || inertias.empty()) return;
    if (is_default) frame.assumed["angular velocities"] = "0, the default of particles/angmom";
    for (std::size_t i = 0; i < particles_; ++i) {
      const Quaternion& q = frame.orientation[i];
      const Vec3 momentum = 0.5 * (q.conjugate() * momenta[i]).vec();
      const double otherwise = inertias[i].maxCoeff();
      Vec3 omega = Vec3::Zero();
      for (int k = 0; k < 3; ++k) {
        const double moment = inertias[i][k] > 0 ? inertias[i][k] : otherwise;
        if (moment > 0) omega[k] = momentum[k] / moment;
      }
      frame.angular_velocity.push_back(q * omega);
    }
  }

  GsdReader file_;
  std::uint64_t number_ = 0;
  std::size_t particles_ = 0;
};

}  // namespace

constexpr ForeignFormat gsd_format = {
    "GSD",
    {"configuration/box", "configuration/dimensions = 2",
     "particles/type_shapes or particles/diameter", "particles/image after the first frame"},
    [](std::string_view start) { return start.starts_with("\xDF\x65\xDF\x65"); },
    [](const std::filesystem::path& path, const ImportOptions&) -> std::unique_ptr<ForeignFrames> {
      return std::make_unique<GsdFrames>(path);
    }};

}  // namespace vitrel
