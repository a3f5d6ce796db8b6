#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/state/configuration.h"

namespace vitrel {

/// Box crossings of a trajectory that does not state them: every particle is taken to have moved by the shortest way
/// from frame to frame, which is right if no step is longer than half a box length.
template <int Dim>
class NearestImages {
 public:
  /// Sets the images of the next frame, those of the first to 0. Where velocities are stored and times known, a
  /// particle that kept its velocity flew straight: UserError if it went to another image than the nearest.
  void set(Configuration<Dim>& next, bool knows_flight);

  /// A sentence on the longest step.
  std::string remark() const;
  /// The frames, in ascending order, to which some particle went so far that it may have gone another way.
  const std::vector<std::size_t>& doubtful_frames() const { return doubtful_; }

 private:
  void compare_with_flight(const Configuration<Dim>& next, std::size_t particle) const;

  struct Step {
    double box_lengths = 0;  ///< along one direction
    std::size_t particle = 0, frame = 0;
    int direction = 0;
  };

  std::optional<Configuration<Dim>> last_;
  std::size_t frames_ = 0;
  Step longest_;
  std::vector<std::size_t> doubtful_;
};

}  // namespace vitrel
