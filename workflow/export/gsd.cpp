#include "workflow/export/gsd.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/io/foreign/gsd_layout.h"
#include "core/io/provenance.h"
#include "core/state/in_space.h"

namespace vitrel {
namespace {

template <class T>
std::string_view bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

template <class T>
constexpr std::uint8_t type_number() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return 1;
  if constexpr (std::is_same_v<T, std::uint32_t>) return 3;
  if constexpr (std::is_same_v<T, std::uint64_t>) return 4;
  if constexpr (std::is_same_v<T, std::int8_t>) return 5;
  if constexpr (std::is_same_v<T, std::int32_t>) return 7;
  if constexpr (std::is_same_v<T, float>) return 9;
  if constexpr (std::is_same_v<T, double>) return 10;
}

/// Writes a GSD file, the general simulation data of HOOMD-blue, file layer 2.0
/// (https://gsd.readthedocs.io/en/stable/file-layer.html). It consists of frames of named arrays, which are called
/// chunks:
///
///     header    256 bytes: the kind of file, and the places of the names and the index
///     chunks    the numbers alone, row by row, one chunk after the other
///     names     of the chunks, each ended by a zero byte, in units of 64 bytes
///     index     32 bytes per chunk, by frame and then by name: place, shape and type
///
/// Names and index come last, so that nothing needs to be known in advance. Memory grows by one index entry per
/// chunk.
class GsdFile {
 public:
  explicit GsdFile(const std::filesystem::path& path) : file_(path) {
    header_.magic = gsd::magic;
    header_.version = 2u << 16;  // versions are major · 2¹⁶ + minor
    header_.schema_version = (1u << 16) + 4;
    ("vitrel " + program_version())
        .copy(header_.application.data(), header_.application.size() - 1);
    std::string_view("hoomd").copy(header_.schema.data(), header_.schema.size() - 1);
    file_.write(
        // This reserves the place of the header, which close overwrites.
        bytes_of(std::span<const gsd::Header>(&header_, 1)));
  }

  /// Adds an array of `columns` numbers per row to the frame. Every frame must write its names in the same order,
  /// each at most once; it may leave some out.
  template <class T>
  void write(const std::string& name, std::span<const T> values, std::uint32_t columns = 1) {
    const std::uint16_t number = number_of(name);
    assert(index_.empty() || index_.back().frame < frame_ || index_.back().name < number);
    index_.push_back({frame_, values.size() / columns, static_cast<std::int64_t>(file_.size()),
                      columns, number, type_number<T>(), 0});
    file_.write(bytes_of(values));
  }
  void end_frame() { ++frame_; }
  void close() {
    write_names();
    write_index();
    file_.write_at_start(bytes_of(std::span<const gsd::Header>(&header_, 1)));
    file_.close();
  }

 private:
  std::uint16_t number_of(const std::string& name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    const auto number = static_cast<std::uint16_t>(found - names_.begin());
    if (found == names_.end()) names_.push_back(name);
    return number;
  }
  void write_names() {
    std::string block;
    for (const std::string& name : names_) block += name + '\0';
    // An additional zero byte ends the list.
    header_.names_units = block.size() / gsd::names_unit + 1;
    header_.names_location = file_.size();
    block.resize(header_.names_units * gsd::names_unit);
    file_.write(block);
  }
  void write_index() {
    index_.push_back({});  // an empty entry ends the list
    header_.index_entries = index_.size();
    header_.index_location = file_.size();
    file_.write(bytes_of(std::span<const gsd::Entry>(index_)));
  }

  OutputFile file_;
  gsd::Header header_{};
  std::vector<std::string> names_;
  std::vector<gsd::Entry> index_;
  std::uint64_t frame_ = 0;
};

constexpr float infinity = std::numeric_limits<float>::infinity();

float rounded_up(double x) {
  const auto result = static_cast<float>(x);
  return result < x ? std::nextafter(result, infinity) : result;
}

/// Rounding is monotonic, so |x| ≤ L/2 still holds in a box that is not smaller. Rounding can reach the upper face,
/// however, which belongs to the next image.
float rounded_inside(double x, float length) {
  const auto result = static_cast<float>(x);
  return result >= length / 2 ? std::nextafter(length / 2, -infinity) : result;
}

void append(std::vector<float>& row, const auto& vector) {
  for (const double number : vector) row.push_back(static_cast<float>(number));
}

void append(std::vector<float>& row, const Quaternion& q) {
  append(row, Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
}

Vec3 modelled_inertia(const Configuration2& configuration, std::size_t i) {
  return {0, 0, configuration.shape[i].is_round() ? 0 : configuration.inertia(i)};
}

Vec3 modelled_inertia(const Configuration3& configuration, std::size_t i) {
  const ParticleShape<3>& shape = configuration.shape[i];
  if (shape.is_round()) return Vec3::Zero();
  Vec3 inertia = configuration.inertia(i);
  if (shape.symmetry_axis() != no_axis) inertia[shape.symmetry_axis()] = 0;
  return inertia;
}

/// The momentum quaternion 2 q (0, L).
Quaternion momentum_quaternion(const Configuration2& configuration, std::size_t i) {
  const double half = 0.5 * configuration.angle[i];
  const double twice =
      2 * modelled_inertia(configuration, i).z() * configuration.angular_velocity[i];
  return {-twice * std::sin(half), 0, 0, twice * std::cos(half)};
}

Quaternion momentum_quaternion(const Configuration3& configuration, std::size_t i) {
  if (configuration.shape[i].is_round()) return {0, 0, 0, 0};
  const Quaternion& q = configuration.orientation[i];
  Quaternion twice(0, 0, 0, 0);
  twice.vec() =
      2 * configuration.inertia(i).cwiseProduct(q.conjugate() * configuration.angular_velocity[i]);
  return q * twice;
}

/// The shape that all particles of a species share; no value if shapes differ or if there are no particles.
using CommonShape = std::optional<Vec3>;

template <int Dim>
std::string shape_text(const CommonShape& axes) {
  if (!axes) return "{}";
  const double a = axes->x(), b = axes->y(), c = axes->z();
  return Dim == 3 && a == b && b == c
             ? fmt::format(R"({{"type":"Sphere","diameter":{}}})", 2 * a)
             : fmt::format(R"({{"type":"Ellipsoid","a":{},"b":{},"c":{}}})", a, b, c);
}

template <int Dim>
std::vector<CommonShape> shapes_of_species(const Configuration<Dim>& configuration) {
  std::vector<CommonShape> shapes(configuration.species_names.size());
  std::vector<bool> differ(shapes.size());
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const auto k = static_cast<std::size_t>(configuration.species[i]);
    const Vec3 axes = half_lengths_in_space(configuration.shape[i]);
    differ[k] = differ[k] || (shapes[k] && *shapes[k] != axes);
    shapes[k] = axes;
  }
  for (std::size_t k = 0; k < shapes.size(); ++k)
    if (differ[k]) shapes[k].reset();
  return shapes;
}

template <int Dim>
class GsdSink final : public FrameSink<Dim> {
 public:
  GsdSink(const std::filesystem::path& path, StoredMotion motion) : file_(path), motion_(motion) {}
  void write(const StoredFrame<Dim>& frame) override {
    const Configuration<Dim>& configuration = frame.configuration;
    const auto step = static_cast<std::uint64_t>(frame.step);
    std::array<float, 6> box{};
    for (int k = 0; k < Dim; ++k) box[k] = rounded_up(configuration.box.lengths()[k]);
    std::vector<float> positions, orientations;
    std::vector<std::int32_t> images;
    for (std::size_t i = 0; i < configuration.size(); ++i) {
      for (int k = 0; k < 3; ++k)
        positions.push_back(k < Dim ? rounded_inside(configuration.position[i][k], box[k]) : 0);
      const Shift<3> image = in_space(configuration.image[i]);
      images.insert(images.end(), image.begin(), image.end());
      append(orientations, orientation_in_space(configuration, i));
    }
    file_.write<std::uint64_t>("configuration/step", {&step, 1});
    file_.write<float>("configuration/box", box);
    if (!has_fixed_) write_fixed(configuration);
    file_.write<float>("particles/position", positions, 3);
    file_.write<float>("particles/orientation", orientations, 4);
    file_.write<std::int32_t>("particles/image", images, 3);
    write_motion(configuration);
    file_.write<double>("log/time", {&configuration.time, 1});
    file_.end_frame();
  }
  void close() override { file_.close(); }

 private:
  /// Writes what does not change; readers of GSD take it from the first frame for all frames.
  void write_fixed(const Configuration<Dim>& configuration) {
    const std::uint8_t dimensions = Dim;
    const auto n = static_cast<std::uint32_t>(configuration.size());
    std::vector<float> masses, inertias;
    for (std::size_t i = 0; i < n; ++i) {
      masses.push_back(static_cast<float>(configuration.mass[i]));
      append(inertias, modelled_inertia(configuration, i));
    }
    file_.write<std::uint8_t>("configuration/dimensions", {&dimensions, 1});
    file_.write<std::uint32_t>("particles/N", {&n, 1});
    write_types(configuration);
    file_.write<float>("particles/mass", masses);
    file_.write<float>("particles/moment_inertia", inertias, 3);
    has_fixed_ = true;
  }
  void write_types(const Configuration<Dim>& configuration) {
    const std::vector<CommonShape> common = shapes_of_species(configuration);
    std::vector<std::string> shapes;
    for (const CommonShape& shape : common) shapes.push_back(shape_text<Dim>(shape));
    write_texts("particles/types", configuration.species_names);
    file_.write<std::uint32_t>(
        "particles/typeid",
        std::vector<std::uint32_t>(configuration.species.begin(), configuration.species.end()));
    write_texts("particles/type_shapes", shapes);
    write_own_shapes(configuration, common);
  }
  /// Writes the sizes of all particles if sizes differ within a species: diameters if all particles of such species
  /// are round, else semi-axes.
  void write_own_shapes(const Configuration<Dim>& configuration,
                        const std::vector<CommonShape>& common) {
    bool some_round = false, some_not = false;
    std::vector<float> diameters;
    std::vector<double> semi_axes;
    for (std::size_t i = 0; i < configuration.size(); ++i) {
      const Vec3 axes = half_lengths_in_space(configuration.shape[i]);
      diameters.push_back(static_cast<float>(2 * axes[0]));
      semi_axes.insert(semi_axes.end(), axes.begin(), axes.end());
      if (common[static_cast<std::size_t>(configuration.species[i])]) continue;
      (configuration.shape[i].is_round() ? some_round : some_not) = true;
    }
    if (some_not)
      file_.write<double>("log/particles/semiaxes", semi_axes, 3);
    else if (some_round)
      file_.write<float>("particles/diameter", diameters);
  }
  /// Writes one row per text, filled up with zero bytes.
  void write_texts(const std::string& name, const std::vector<std::string>& texts) {
    std::size_t width = 0;
    for (const std::string& text : texts) width = std::max(width, text.size() + 1);
    std::vector<std::int8_t> rows(texts.size() * width);
    for (std::size_t k = 0; k < texts.size(); ++k)
      std::copy(texts[k].begin(), texts[k].end(), rows.begin() + static_cast<long>(k * width));
    file_.write<std::int8_t>(name, rows, static_cast<std::uint32_t>(width));
  }
  void write_motion(const Configuration<Dim>& configuration) {
    std::vector<float> velocities, momenta;
    for (std::size_t i = 0; i < configuration.size(); ++i) {
      append(velocities, in_space(configuration.velocity[i]));
      append(momenta, momentum_quaternion(configuration, i));
    }
    if (motion_.velocities) file_.write<float>("particles/velocity", velocities, 3);
    if (motion_.angular_velocities) file_.write<float>("particles/angmom", momenta, 4);
  }

  GsdFile file_;
  StoredMotion motion_;
  bool has_fixed_ = false;
};

}  // namespace

template <int Dim>
std::unique_ptr<FrameSink<Dim>> gsd_sink(const std::filesystem::path& path, StoredMotion motion) {
  return std::make_unique<GsdSink<Dim>>(path, motion);
}

template std::unique_ptr<FrameSink<2>> gsd_sink(const std::filesystem::path&, StoredMotion);
template std::unique_ptr<FrameSink<3>> gsd_sink(const std::filesystem::path&, StoredMotion);

}  // namespace vitrel
