#pragma once

#include <filesystem>

#include "workflow/export/frame_sink.h"

namespace vitrel {

/// A trajectory as extended XYZ, frame after frame, every number with the digits, 17 at most, that
/// give the same double back. OVITO takes the columns for what they are by their names; ASE keeps
/// all of them as arrays.
///
///     Lattice, Origin                   the box, centred at the origin; pbc="T T T". In the plane
///                                       of height 1; pbc="T T F"
///     Time, Step
///     type                              the name of the species, spaces replaced by "_"
///     id                                from 0
///     pos, map_shift                    wrapped, in the plane z = 0;
///                                       unwrapped = pos + map_shift ∘ box
///     angle                             in the plane only: unwrapped, radians
///     orientation                       quaternion x, y, z, w; in the plane (0, 0, sin θ/2, cos θ/2)
///     aspherical_shape                  semi-axes a, b, c; in the plane c = b, for the sake of
///                                       being seen
///     mass
///     velo, omega                       velocity and angular velocity, both in the axes of space, if
///                                       the trajectory has them
template <int Dim>
class XyzSink final : public FrameSink<Dim> {
 public:
  XyzSink(const std::filesystem::path& path, StoredMotion motion) : file_(path), motion_(motion) {}
  void write(const StoredFrame<Dim>& frame) override;
  void close() override { file_.close(); }

 private:
  OutputFile file_;
  StoredMotion motion_;
};

}  // namespace vitrel
