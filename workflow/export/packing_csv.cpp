#include <fmt/format.h>

#include <iterator>

#include "workflow/export/csv.h"
#include "workflow/export/frame_sink.h"
#include "workflow/export/packing.h"

namespace vitrel {

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
    const Vec3& axes = configuration.shape[i].semi_axes;
    const Quaternion& q = configuration.orientation[i];
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", i,
                   csv_field(configuration.species_names[configuration.species[i]]), body.shift.x(),
                   body.shift.y(), body.shift.z(), centre.x(), centre.y(), centre.z(), axes[0],
                   axes[1], axes[2], q.w(), q.x(), q.y(), q.z(), box.x(), box.y(), box.z());
  }
  OutputFile file(path);
  file.write({text.data(), text.size()});
  file.close();
}

}  // namespace vitrel
