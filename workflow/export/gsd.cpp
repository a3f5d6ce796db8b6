#include "workflow/export/gsd.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "core/error.h"
#include "core/io/provenance.h"

namespace vitrel {
namespace {

constexpr std::uint32_t schema_version = (1u << 16) + 4;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// The particles of one species and shape.
using Type = std::tuple<std::int32_t, double, double>;

float rounded_up(double x) {
  const auto result = static_cast<float>(x);
  return result < x ? std::nextafter(result, infinity) : result;
}

/// Rounding is monotonic, so |x| ≤ L/2 stays so in a box that is not smaller; only the upper face,
/// which belongs to the next image, can be met.
float rounded_inside(double x, float length) {
  const auto result = static_cast<float>(x);
  return result >= length / 2 ? std::nextafter(length / 2, -infinity) : result;
}

double modelled_inertia(const Configuration2& configuration, std::size_t i) {
  return configuration.shape[i].is_round() ? 0 : configuration.inertia(i);
}

std::string shape_text(const Type& type) {
  return fmt::format(R"({{"type":"Ellipsoid","a":{0},"b":{1},"c":{1}}})", std::get<1>(type),
                     std::get<2>(type));
}

/// The name of the species, with a number if it has several types; no name comes twice.
std::vector<std::string> names_of(const std::vector<Type>& types,
                                  const std::vector<std::string>& species) {
  std::vector<int> count(species.size()), number(species.size());
  for (const Type& type : types) ++count[std::get<0>(type)];
  std::set<std::string> taken(species.begin(), species.end());
  std::vector<std::string> names;
  for (const Type& type : types) {
    const auto k = static_cast<std::size_t>(std::get<0>(type));
    std::string name = species[k];
    if (count[k] > 1) {
      do {
        name = fmt::format("{}#{}", species[k], ++number[k]);
      } while (!taken.insert(name).second);
    }
    names.push_back(name);
  }
  return names;
}

}  // namespace

GsdSink::GsdSink(const std::filesystem::path& path, StoredMotion motion)
    : file_(path, "vitrel " + program_version(), "hoomd", schema_version), motion_(motion) {}

void GsdSink::write(const StoredFrame& frame) {
  const Configuration2& configuration = frame.configuration;
  const auto step = static_cast<std::uint64_t>(frame.step);
  const Vec2& lengths = configuration.box.lengths();
  const std::array<float, 6> box{rounded_up(lengths.x()), rounded_up(lengths.y()), 0, 0, 0, 0};
  std::vector<float> positions, orientations;
  std::vector<std::int32_t> images;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Vec2& position = configuration.position[i];
    const Shift<2>& image = configuration.image[i];
    const double half = 0.5 * configuration.angle[i];
    positions.insert(positions.end(), {rounded_inside(position.x(), box[0]),
                                       rounded_inside(position.y(), box[1]), 0.0f});
    images.insert(images.end(), {image.x(), image.y(), 0});
    orientations.insert(orientations.end(), {static_cast<float>(std::cos(half)), 0.0f, 0.0f,
                                             static_cast<float>(std::sin(half))});
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

/// What the first frame says holds for all.
void GsdSink::write_fixed(const Configuration2& configuration) {
  const std::uint8_t dimensions = 2;
  const auto n = static_cast<std::uint32_t>(configuration.size());
  std::vector<float> masses, inertias;
  for (std::size_t i = 0; i < n; ++i) {
    masses.push_back(static_cast<float>(configuration.mass[i]));
    inertias.insert(inertias.end(),
                    {0.0f, 0.0f, static_cast<float>(modelled_inertia(configuration, i))});
  }
  file_.write<std::uint8_t>("configuration/dimensions", {&dimensions, 1});
  file_.write<std::uint32_t>("particles/N", {&n, 1});
  write_types(configuration);
  file_.write<float>("particles/mass", masses);
  file_.write<float>("particles/moment_inertia", inertias, 3);
  has_fixed_ = true;
}

void GsdSink::write_types(const Configuration2& configuration) {
  std::map<Type, std::uint32_t> number;
  std::vector<Type> types;
  std::vector<std::uint32_t> type_ids;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Ellipse& shape = configuration.shape[i];
    const Type type{configuration.species[i], shape.a, shape.b};
    const auto [place, is_new] = number.emplace(type, static_cast<std::uint32_t>(types.size()));
    if (is_new) types.push_back(type);
    type_ids.push_back(place->second);
  }
  if (types.size() > max_types)
    throw UserError(fmt::format(
        "the particles have {} different shapes, but a GSD file names every shape, and more than "
        "{} are too many for the programs that read it; --to xyz or csv writes the semi-axes of "
        "every particle",
        types.size(), max_types));
  std::vector<std::string> shapes;
  for (const Type& type : types) shapes.push_back(shape_text(type));
  write_texts("particles/types", names_of(types, configuration.species_names));
  file_.write<std::uint32_t>("particles/typeid", type_ids);
  write_texts("particles/type_shapes", shapes);
}

/// One row per text, filled up with zero bytes.
void GsdSink::write_texts(const std::string& name, const std::vector<std::string>& texts) {
  std::size_t width = 0;
  for (const std::string& text : texts) width = std::max(width, text.size() + 1);
  std::vector<std::int8_t> rows(texts.size() * width);
  for (std::size_t k = 0; k < texts.size(); ++k)
    std::copy(texts[k].begin(), texts[k].end(), rows.begin() + static_cast<long>(k * width));
  file_.write<std::int8_t>(name, rows, static_cast<std::uint32_t>(width));
}

void GsdSink::write_motion(const Configuration2& configuration) {
  std::vector<float> velocities, momenta;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Vec2& v = configuration.velocity[i];
    const double half = 0.5 * configuration.angle[i];
    const double twice = 2 * modelled_inertia(configuration, i) * configuration.angular_velocity[i];
    velocities.insert(velocities.end(),
                      {static_cast<float>(v.x()), static_cast<float>(v.y()), 0.0f});
    momenta.insert(momenta.end(), {static_cast<float>(-twice * std::sin(half)), 0.0f, 0.0f,
                                   static_cast<float>(twice * std::cos(half))});
  }
  if (motion_.velocities) file_.write<float>("particles/velocity", velocities, 3);
  if (motion_.angular_velocities) file_.write<float>("particles/angmom", momenta, 4);
}

}  // namespace vitrel
