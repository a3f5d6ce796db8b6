#pragma once

#include <filesystem>
#include <vector>

#include "workflow/export/frame_sink.h"
#include "workflow/export/gsd_file.h"

namespace vitrel {

/// A trajectory in HOOMD-blue's schema of GSD, for HOOMD-blue, OVITO, freud and gsd.hoomd. Numbers
/// are rounded to single precision, so neighbours in contact may overlap by 1e-7 of the box.
///
///     configuration/step, dimensions = 2, box = [L_x, L_y, 0, 0, 0, 0]   L_z = 0: the plane
///     particles/N, position, image                 wrapped; unwrapped = position + image ∘ box
///     particles/orientation                        quaternion (cos θ/2, 0, 0, sin θ/2)
///     particles/types, typeid, type_shapes         a type per species and shape, named by the
///         species, or `<species>#1`, `#2` … if its shapes differ; {"type":"Ellipsoid","a":a,"b":b,"c":b}.
///         The axis out of the plane is b: HOOMD-blue and OVITO do not take a flat one
///     particles/mass, moment_inertia = (0, 0, I)   I = 0 if round: rotation is not modelled
///     particles/velocity                           if the trajectory has it
///     particles/angmom                             the quaternion 2 q (0, 0, 0, I ω), likewise
///     log/time
///
/// The edges of the box are rounded up, and so no position is rounded out of it.
class GsdSink final : public FrameSink {
 public:
  /// Each type has a name and a shape in the file: a polydisperse system of many more particles
  /// would give a file that programs choke on.
  static constexpr std::size_t max_types = 20'000;

  GsdSink(const std::filesystem::path& path, StoredMotion motion);
  /// UserError if the particles have more than `max_types` shapes.
  void write(const StoredFrame& frame) override;
  void close() override { file_.close(); }

 private:
  void write_fixed(const Configuration2& configuration);
  void write_types(const Configuration2& configuration);
  void write_texts(const std::string& name, const std::vector<std::string>& texts);
  void write_motion(const Configuration2& configuration);

  GsdFile file_;
  StoredMotion motion_;
  bool has_fixed_ = false;
};

}  // namespace vitrel
