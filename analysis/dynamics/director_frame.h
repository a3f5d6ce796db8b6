#pragma once

#include <type_traits>
#include <vector>

#include "analysis/trajectory.h"

namespace vitrel {

/// A trajectory as seen from its director. Orientations are relative to the director of each frame (order.h,
/// orientation_tensor.h), which is followed from frame to frame; the rest is that of the whole trajectory, which must
/// outlive this one. In the plane the turns of the director are counted, so that angles stay unwrapped. In space every
/// frame is turned by the shortest rotations that carry the director back to that of the frame before, and so on to the
/// first. In a box of R particles that are not round, the director of a nematic is free to turn, slowly, as a whole;
/// this frame shows the rotation of particles without it. The constructor makes one pass over all frames. Validity: the
/// director must turn by less than a right angle between two frames.
template <int Dim>
class DirectorFrame : public Trajectory<Dim> {
 public:
  explicit DirectorFrame(Trajectory<Dim>& whole);
  const std::vector<double>& times() const override { return whole_.times(); }
  const Configuration<Dim>& read(std::size_t k) override { return turned(whole_.read(k), k); }
  const Configuration<Dim>& read_places(std::size_t k) override {
    return turned(whole_.read_places(k), k);
  }

 private:
  /// An angle, or the rotation from the frame of the first director.
  using Turn = std::conditional_t<Dim == 2, double, Quaternion>;

  const Configuration<Dim>& turned(const Configuration<Dim>& frame, std::size_t k);

  Trajectory<Dim>& whole_;
  std::vector<Turn> turn_;
  Configuration<Dim> frame_;
};

}  // namespace vitrel
