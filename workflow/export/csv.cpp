#include "workflow/export/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <string_view>

namespace vitrel {
namespace {

/// A column for every direction, whose letter stands for {}.
template <int Dim>
std::string directions(std::string_view column) {
  std::string text;
  for (const char direction : std::string_view("xyz").substr(0, Dim))
    text += fmt::format(fmt::runtime(column), direction);
  return text;
}

template <int Dim>
std::string header(const StoredMotion& motion) {
  std::string text = "frame [1],step [1],time [time]" + directions<Dim>(",box_{} [length]") +
                     ",id [1],species [1]" + directions<Dim>(",{} [length]") +
                     directions<Dim>(",unwrapped_{} [length]");
  text += Dim == 2 ? ",angle [rad],a [length],b [length]"
                   : ",qw [1],qx [1],qy [1],qz [1],a [length],b [length],c [length]";
  text += ",mass [mass]";
  if (motion.velocities) text += directions<Dim>(",v{} [length/time]");
  if (motion.angular_velocities)
    text += Dim == 2 ? ",omega [rad/time]" : directions<Dim>(",omega_{} [rad/time]");
  return text + '\n';
}

// What a particle has in the columns that differ between plane and space.

Eigen::Array3d orientation_and_shape(const Configuration2& configuration, std::size_t i) {
  const Ellipse& shape = configuration.shape[i];
  return {configuration.angle[i], shape.a, shape.b};
}

Eigen::Array<double, 7, 1> orientation_and_shape(const Configuration3& configuration,
                                                 std::size_t i) {
  const Quaternion& q = configuration.orientation[i];
  const Vec3& axes = configuration.shape[i].semi_axes;
  return {{q.w(), q.x(), q.y(), q.z(), axes[0], axes[1], axes[2]}};
}

Vec<1> components(double number) {
  return Vec<1>(number);
}
const Vec3& components(const Vec3& vector) {
  return vector;
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

template <int Dim>
CsvSink<Dim>::CsvSink(const std::filesystem::path& path, StoredMotion motion)
    : file_(path), motion_(motion) {
  file_.write(header<Dim>(motion));
}

template <int Dim>
void CsvSink<Dim>::write(const StoredFrame<Dim>& frame) {
  const Configuration<Dim>& configuration = frame.configuration;
  const std::string start = fmt::format("{},{},{},{}", frame.index, frame.step, configuration.time,
                                        fmt::join(configuration.box.lengths(), ","));
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  const auto append = [&](const auto& vector) {
    for (const double number : vector) fmt::format_to(out, ",{}", number);
  };
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    fmt::format_to(out, "{},{},{}", start, i,
                   csv_field(configuration.species_names[configuration.species[i]]));
    append(configuration.position[i]);
    append(configuration.unwrapped(i));
    append(orientation_and_shape(configuration, i));
    fmt::format_to(out, ",{}", configuration.mass[i]);
    if (motion_.velocities) append(configuration.velocity[i]);
    if (motion_.angular_velocities) append(components(configuration.angular_velocity[i]));
    text.push_back('\n');
  }
  file_.write({text.data(), text.size()});
}

template class CsvSink<2>;
template class CsvSink<3>;

}  // namespace vitrel
