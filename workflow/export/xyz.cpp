#include "workflow/export/xyz.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <iterator>

namespace vitrel {
namespace {

std::string one_word(std::string name) {
  for (char& c : name)
    if (std::isspace(static_cast<unsigned char>(c))) c = '_';
  return name;
}

std::string comment(const StoredFrame& frame, const StoredMotion& motion) {
  const Vec2& box = frame.configuration.box.lengths();
  return fmt::format(
      "Lattice=\"{} 0 0 0 {} 0 0 0 1\" Origin=\"{} {} -0.5\" pbc=\"T T F\" "
      "Time={} Step={} Properties=type:S:1:id:I:1:pos:R:3:map_shift:I:3:angle:R:1:"
      "orientation:R:4:aspherical_shape:R:3:mass:R:1{}{}",
      box.x(), box.y(), -0.5 * box.x(), -0.5 * box.y(), frame.configuration.time, frame.step,
      motion.velocities ? ":velo:R:3" : "", motion.angular_velocities ? ":omega:R:3" : "");
}

}  // namespace

void XyzSink::write(const StoredFrame& frame) {
  const Configuration2& configuration = frame.configuration;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{}\n{}\n", configuration.size(), comment(frame, motion_));
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Vec2& position = configuration.position[i];
    const Shift<2>& image = configuration.image[i];
    const Vec2& velocity = configuration.velocity[i];
    const Ellipse& shape = configuration.shape[i];
    const double angle = configuration.angle[i];
    fmt::format_to(out, "{} {} {} {} 0 {} {} 0 {} 0 0 {} {} {} {} {}",
                   one_word(configuration.species_names[configuration.species[i]]), i, position.x(),
                   position.y(), image.x(), image.y(), angle, std::sin(0.5 * angle),
                   std::cos(0.5 * angle), shape.a, shape.b, shape.b);
    fmt::format_to(out, " {}", configuration.mass[i]);
    if (motion_.velocities) fmt::format_to(out, " {} {} 0", velocity.x(), velocity.y());
    if (motion_.angular_velocities)
      fmt::format_to(out, " 0 0 {}", configuration.angular_velocity[i]);
    text.push_back('\n');
  }
  file_.write({text.data(), text.size()});
}

}  // namespace vitrel
