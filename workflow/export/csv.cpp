#include "workflow/export/csv.h"

#include <fmt/format.h>

#include <iterator>

namespace vitrel {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

CsvSink::CsvSink(const std::filesystem::path& path, StoredMotion motion)
    : file_(path), motion_(motion) {
  std::string header =
      "frame [1],step [1],time [time],box_x [length],box_y [length],id [1],species [1],"
      "x [length],y [length],unwrapped_x [length],unwrapped_y [length],angle [rad],a [length],"
      "b [length],mass [mass]";
  if (motion.velocities) header += ",vx [length/time],vy [length/time]";
  if (motion.angular_velocities) header += ",omega [rad/time]";
  file_.write(header + '\n');
}

void CsvSink::write(const StoredFrame& frame) {
  const Configuration2& configuration = frame.configuration;
  const Vec2& box = configuration.box.lengths();
  const std::string start =
      fmt::format("{},{},{},{},{}", frame.index, frame.step, configuration.time, box.x(), box.y());
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Vec2& position = configuration.position[i];
    const Vec2 unwrapped = configuration.unwrapped(i);
    const Ellipse& shape = configuration.shape[i];
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{}", start, i,
                   csv_field(configuration.species_names[configuration.species[i]]), position.x(),
                   position.y(), unwrapped.x(), unwrapped.y(), configuration.angle[i], shape.a,
                   shape.b, configuration.mass[i]);
    if (motion_.velocities)
      fmt::format_to(out, ",{},{}", configuration.velocity[i].x(), configuration.velocity[i].y());
    if (motion_.angular_velocities) fmt::format_to(out, ",{}", configuration.angular_velocity[i]);
    text.push_back('\n');
  }
  file_.write({text.data(), text.size()});
}

}  // namespace vitrel
