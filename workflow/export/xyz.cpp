#include "workflow/export/xyz.h"

#include <fmt/format.h>

#include <cctype>
#include <iterator>

#include "core/state/in_space.h"

namespace vitrel {
namespace {

std::string one_word(std::string name) {
  for (char& c : name)
    if (std::isspace(static_cast<unsigned char>(c))) c = '_';
  return name;
}

template <int Dim>
std::string comment(const StoredFrame<Dim>& frame, const StoredMotion& motion) {
  Vec3 box = Vec3::Ones();
  box.head<Dim>() = frame.configuration.box.lengths();
  const Vec3 origin = -0.5 * box;
  return fmt::format(
      "Lattice=\"{} 0 0 0 {} 0 0 0 {}\" Origin=\"{} {} {}\" pbc=\"T T {}\" "
      "Time={} Step={} Properties=type:S:1:id:I:1:pos:R:3:map_shift:I:3:{}"
      "orientation:R:4:aspherical_shape:R:3:mass:R:1{}{}",
      box.x(), box.y(), box.z(), origin.x(), origin.y(), origin.z(), Dim == 2 ? 'F' : 'T',
      frame.configuration.time, frame.step, Dim == 2 ? "angle:R:1:" : "",
      motion.velocities ? ":velo:R:3" : "", motion.angular_velocities ? ":omega:R:3" : "");
}

}  // namespace

template <int Dim>
void XyzSink<Dim>::write(const StoredFrame<Dim>& frame) {
  const Configuration<Dim>& configuration = frame.configuration;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  const auto append = [&](const auto& vector) {
    for (const auto number : vector) fmt::format_to(out, " {}", number);
  };
  fmt::format_to(out, "{}\n{}\n", configuration.size(), comment(frame, motion_));
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    fmt::format_to(out, "{} {}", one_word(configuration.species_names[configuration.species[i]]),
                   i);
    append(in_space(configuration.position[i]));
    append(in_space(configuration.image[i]));
    if constexpr (Dim == 2) fmt::format_to(out, " {}", configuration.angle[i]);
    append(orientation_in_space(configuration, i).coeffs());  // x, y, z, w
    append(semi_axes_in_space(configuration.shape[i]));
    fmt::format_to(out, " {}", configuration.mass[i]);
    if (motion_.velocities) append(in_space(configuration.velocity[i]));
    if (motion_.angular_velocities)
      append(angular_velocity_in_space(configuration.angular_velocity[i]));
    text.push_back('\n');
  }
  file_.write({text.data(), text.size()});
}

template class XyzSink<2>;
template class XyzSink<3>;

}  // namespace vitrel
