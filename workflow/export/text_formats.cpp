#include "workflow/export/text_formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <iterator>
#include <string>

#include "core/state/in_space.h"
#include "workflow/export/packing.h"

namespace vitrel {
namespace {

/// A text that contains a comma, a quote or a line break is put in quotes, and quotes in it are doubled.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

/// Repeats the column for every direction, whose letter replaces {}.
template <int Dim>
std::string directions(std::string_view column) {
  std::string text;
  for (const char direction : std::string_view("xyz").substr(0, Dim))
    text += fmt::format(fmt::runtime(column), direction);
  return text;
}

template <int Dim>
std::string csv_header(const StoredMotion& motion) {
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

// The columns of a particle that differ between plane and space.

Eigen::Array3d orientation_and_shape(const Configuration2& configuration, std::size_t i) {
  const Vec2 half = configuration.shape[i].half_lengths();
  return {configuration.angle[i], half[0], half[1]};
}

Eigen::Array<double, 7, 1> orientation_and_shape(const Configuration3& configuration,
                                                 std::size_t i) {
  const Quaternion& q = configuration.orientation[i];
  const Vec3& axes = configuration.shape[i].half_lengths();
  return {{q.w(), q.x(), q.y(), q.z(), axes[0], axes[1], axes[2]}};
}

Vec<1> components(double number) {
  return Vec<1>(number);
}
const Vec3& components(const Vec3& vector) {
  return vector;
}

template <int Dim>
void append_csv(fmt::memory_buffer& text, const StoredFrame<Dim>& frame, StoredMotion motion) {
  const Configuration<Dim>& configuration = frame.configuration;
  const std::string start = fmt::format("{},{},{},{}", frame.index, frame.step, configuration.time,
                                        fmt::join(configuration.box.lengths(), ","));
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
    if (motion.velocities) append(configuration.velocity[i]);
    if (motion.angular_velocities) append(components(configuration.angular_velocity[i]));
    text.push_back('\n');
  }
}

std::string one_word(std::string name) {
  for (char& c : name)
    if (std::isspace(static_cast<unsigned char>(c))) c = '_';
  return name;
}

template <int Dim>
std::string xyz_comment(const StoredFrame<Dim>& frame, const StoredMotion& motion) {
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

template <int Dim>
void append_xyz(fmt::memory_buffer& text, const StoredFrame<Dim>& frame, StoredMotion motion) {
  const Configuration<Dim>& configuration = frame.configuration;
  const auto out = std::back_inserter(text);
  const auto append = [&](const auto& vector) {
    for (const auto number : vector) fmt::format_to(out, " {}", number);
  };
  fmt::format_to(out, "{}\n{}\n", configuration.size(), xyz_comment(frame, motion));
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    fmt::format_to(out, "{} {}", one_word(configuration.species_names[configuration.species[i]]),
                   i);
    append(in_space(configuration.position[i]));
    append(in_space(configuration.image[i]));
    if constexpr (Dim == 2) fmt::format_to(out, " {}", configuration.angle[i]);
    append(orientation_in_space(configuration, i).coeffs());  // coeffs() are x, y, z, w
    append(half_lengths_in_space(configuration.shape[i]));
    fmt::format_to(out, " {}", configuration.mass[i]);
    if (motion.velocities) append(in_space(configuration.velocity[i]));
    if (motion.angular_velocities)
      append(angular_velocity_in_space(configuration.angular_velocity[i]));
    text.push_back('\n');
  }
}

void append_xytheta(fmt::memory_buffer& text, const StoredFrame<2>& frame, StoredMotion) {
  const Configuration2& configuration = frame.configuration;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{}", configuration.time);
  for (std::size_t i = 0; i < configuration.size(); ++i)
    fmt::format_to(out, " {} {} {}", configuration.position[i].x(), configuration.position[i].y(),
                   configuration.angle[i]);
  text.push_back('\n');
}

template <int Dim>
class TextSink final : public FrameSink<Dim> {
 public:
  using Append = void (*)(fmt::memory_buffer&, const StoredFrame<Dim>&, StoredMotion);
  TextSink(const std::filesystem::path& path, const std::string& header, Append append,
           StoredMotion motion)
      : file_(path), append_(append), motion_(motion) {
    file_.write(header);
  }
  void write(const StoredFrame<Dim>& frame) override {
    fmt::memory_buffer text;
    append_(text, frame, motion_);
    file_.write({text.data(), text.size()});
  }
  void close() override { file_.close(); }

 private:
  OutputFile file_;
  Append append_;
  StoredMotion motion_;
};

}  // namespace

template <int Dim>
std::unique_ptr<FrameSink<Dim>> text_sink(std::string_view format,
                                          const std::filesystem::path& path, StoredMotion motion) {
  using Sink = TextSink<Dim>;
  if constexpr (Dim == 2)
    if (format == "xytheta") return std::make_unique<Sink>(path, "", append_xytheta, motion);
  if (format == "xyz") return std::make_unique<Sink>(path, "", append_xyz<Dim>, motion);
  return std::make_unique<Sink>(path, csv_header<Dim>(motion), append_csv<Dim>, motion);
}

void write_packing_csv(const std::filesystem::path& path, const Packing& packing) {
  const Configuration3& configuration = packing.configuration;
  const Vec3& box = configuration.box.lengths();
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out,
      "particle [1],species [1],image_x [1],image_y [1],image_z [1],x [length],y [length],"
      "z [length],a [length],b [length],c [length],qw [1],qx [1],qy [1],qz [1],"
      "box_x [length],box_y [length],box_z [length]\n");
  for (const BodyInBox& body : packing.bodies) {
    const std::size_t i = body.particle;
    const Vec3 centre = packing.centre(body);
    const Vec3& axes = configuration.shape[i].half_lengths();
    const Quaternion& q = configuration.orientation[i];
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", i,
                   csv_field(configuration.species_names[configuration.species[i]]), body.shift.x(),
                   body.shift.y(), body.shift.z(), centre.x(), centre.y(), centre.z(), axes[0],
                   axes[1], axes[2], q.w(), q.x(), q.y(), q.z(), box.x(), box.y(), box.z());
  }
  write_file(path, {text.data(), text.size()});
}

template std::unique_ptr<FrameSink<2>> text_sink(std::string_view, const std::filesystem::path&,
                                                 StoredMotion);
template std::unique_ptr<FrameSink<3>> text_sink(std::string_view, const std::filesystem::path&,
                                                 StoredMotion);

}  // namespace vitrel
