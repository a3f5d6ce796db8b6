#pragma once

#include <vector>

#include "analysis/trajectory.h"

namespace vitrel {

/// A trajectory as seen from its director: angles are those to the director of each frame (order.h), whose
/// turns are followed from frame to frame, so that angles stay unwrapped; the rest is that of the whole,
/// which must outlive it. In a box of R particles that are not round the director of a nematic is free
/// to turn, slowly, as a whole: rotation in this frame is that beside it. One pass over all frames when
/// made. Valid where the director turns by less than a right angle between two frames.
class DirectorFrame : public Trajectory {
 public:
  explicit DirectorFrame(Trajectory& whole);
  const std::vector<double>& times() const override { return whole_.times(); }
  const Configuration2& read(std::size_t k) override;

 private:
  Trajectory& whole_;
  std::vector<double> director_;
  Configuration2 frame_;
};

}  // namespace vitrel
