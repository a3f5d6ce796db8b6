#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "core/io/box_crossings.h"
#include "core/io/foreign/foreign_formats.h"
#include "core/io/foreign/gsd_reader.h"
#include "core/io/json.h"

namespace vitrel {
namespace {

/// The name of the species that a type "A#2" is a part of, in files of earlier versions of vitrel.
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

  /// A row per particle; empty if it is not there.
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
    // What the schema supplies for so many particles then fits into the memory, too.
    if (frame.position.size() != particles_)
      fail("particles/position should have a row for each of the particles/N particles");
    frame.orientation = quaternions("particles/orientation");
    if (frame.orientation.empty()) {
      frame.orientation.assign(particles_, Quaternion::Identity());
      frame.assumed["orientations"] = "not turned, the default of particles/orientation";
    }
    set_images(frame);
  }

  /// Many programs write images into the first frame only, or not at all: those of later frames are then unknown, and not
  /// the same.
  void set_images(ForeignFrame& frame) {
    if (file_.frames() > 1 && !file_.is_in_later_frames("particles/image")) return;
    for (const Vec3& image : vectors("particles/image")) {
      if (!(image.cwiseAbs().maxCoeff() <= max_box_crossings))
        fail("particles/image has impossible numbers");
      frame.image.push_back(image.cast<std::int32_t>());
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
    const std::vector<Vec3> semi_axes = vectors("log/particles/semiaxes");
    std::size_t without_shape = 0;
    if (types.size() > 1 && is_absent("particles/typeid"))
      frame.assumed["species"] = types.front() + ", the default of particles/typeid";
    for (const double type : column("particles/typeid", 0)) {
      if (!(type >= 0 && type < static_cast<double>(types.size())))
        fail(fmt::format("particles/typeid has the type {}, but there are {}", type, types.size()));
      const auto k = static_cast<std::size_t>(type);
      frame.species.push_back(species_of(types[k]));
      const std::size_t i = frame.semi_axes.size();
      if (!shapes.empty() && shapes[k]) {
        frame.semi_axes.push_back(*shapes[k]);
      } else if (!semi_axes.empty()) {
        frame.semi_axes.push_back(semi_axes[i]);
      } else {
        frame.semi_axes.push_back(Vec3::Constant(i < diameters.size() ? 0.5 * diameters[i] : 0));
        ++without_shape;
      }
    }
    if (without_shape > 0 && diameters.empty()) frame.semi_axes.clear();
    if (without_shape == 0 && !diameters.empty())
      frame.skipped.insert("particles/diameter, as the shapes say more");
  }

  /// The semi-axes of every type that has a shape; empty if the file does not have any.
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

  /// The angular momentum L is stored as 2 q (0, L), L and the moments about the own axes. Where a moment is 0 the
  /// rotation is not modelled; of spheroids written by vitrel it is then about the axis, ω = L/I⊥.
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
