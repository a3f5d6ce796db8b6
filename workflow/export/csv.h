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
///     frame, step, time            frame: its place in the trajectory, from 0
///     box_x, box_y
///     id, species                  id from 0
///     x, y                         wrapped into the box centred at the origin
///     unwrapped_x, unwrapped_y
///     angle                        unwrapped
///     a, b                         semi-axes a ≥ b; the angle points along a
///     mass
///     vx, vy, omega                velocity and angular velocity, if the trajectory has them
class CsvSink final : public FrameSink {
 public:
  CsvSink(const std::filesystem::path& path, StoredMotion motion);
  void write(const StoredFrame& frame) override;
  void close() override { file_.close(); }

 private:
  OutputFile file_;
  StoredMotion motion_;
};

}  // namespace vitrel
