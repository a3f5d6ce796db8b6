#pragma once

#include <filesystem>

#include "workflow/export/frame_sink.h"

namespace vitrel {

/// A trajectory in the plane as plain text, as the program that animates it in appendix B.3 of woetzel2012 reads
/// it: a line per frame and no header line,
///
///     t x₁ y₁ θ₁ x₂ y₂ θ₂ …
///
/// separated by spaces, every number with the digits, 17 at most, that give the same double back.
///
/// - x and y are wrapped into the box centred at the origin, as that program draws the square from −R/2 to R/2 and
///   nothing outside. A particle that leaves the box between two frames therefore jumps to the opposite side.
/// - θ is the angle from the x axis to the major axis in radians, unwrapped: the program interpolates it between
///   frames.
///
/// The text has neither the box nor the shapes. The program computes them from NU, AR and PF, for equal particles with
/// a b = 1 in a square box.
class XyThetaSink final : public FrameSink<2> {
 public:
  explicit XyThetaSink(const std::filesystem::path& path) : file_(path) {}
  void write(const StoredFrame<2>& frame) override;
  void close() override { file_.close(); }

 private:
  OutputFile file_;
};

}  // namespace vitrel
