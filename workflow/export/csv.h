#pragma once

#include <filesystem>
#include <string>

#include "workflow/export/frame_sink.h"

namespace vitrel {

/// A text that holds a comma, a quote or a line break stands in quotes, quotes in it doubled.
std::string csv_field(const std::string& text);

/// A trajectory as one table: a line per frame and particle, after one line of `name [unit]`, every
/// number with the digits, 17 at most, that give the same double back.
///
///     in the plane                 in space
///     frame, step, time            the same          frame: its place in the trajectory, from 0
///     box_x, box_y                 …, box_z
///     id, species                  the same          id from 0
///     x, y                         …, z              wrapped into the box centred at the origin
///     unwrapped_x, unwrapped_y     …, unwrapped_z
///     angle                        qw, qx, qy, qz    unwrapped; the quaternion that turns the own
///                                                    axes into those of space
///     a, b                         a, b, c           semi-axes: a ≥ b, the angle points along a; in
///                                                    space along the own x, y and z axes
///     mass                         the same
///     vx, vy                       …, vz             velocity, if the trajectory has it
///     omega                        omega_x, …        angular velocity in the axes of space, likewise
template <int Dim>
class CsvSink final : public FrameSink<Dim> {
 public:
  CsvSink(const std::filesystem::path& path, StoredMotion motion);
  void write(const StoredFrame<Dim>& frame) override;
  void close() override { file_.close(); }

 private:
  OutputFile file_;
  StoredMotion motion_;
};

}  // namespace vitrel
