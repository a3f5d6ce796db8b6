#pragma once

#include <filesystem>

#include "workflow/export/frame_sink.h"

namespace vitrel {

/// A trajectory as extended XYZ, frame after frame, every number with the digits, 17 at most, that
/// give the same double back. OVITO takes the columns for what they are by their names; ASE keeps
/// all of them as arrays.
///
///     Lattice, Origin                   the box, of height 1, centred at the origin; pbc="T T F"
///     Time, Step
///     type                              the name of the species, spaces replaced by "_"
///     id                                from 0
///     pos, map_shift                    wrapped, z = 0; unwrapped = pos + map_shift ∘ box
///     angle                             unwrapped, radians
///     orientation                       quaternion x, y, z, w = (0, 0, sin θ/2, cos θ/2)
///     aspherical_shape                  semi-axes a, b, and b out of the plane, for the sake of
///                                       being seen
///     mass
///     velo, omega                       velocity and angular velocity, if the trajectory has them
class XyzSink final : public FrameSink {
 public:
  XyzSink(const std::filesystem::path& path, StoredMotion motion) : file_(path), motion_(motion) {}
  void write(const StoredFrame& frame) override;
  void close() override { file_.close(); }

 private:
  OutputFile file_;
  StoredMotion motion_;
};

}  // namespace vitrel
