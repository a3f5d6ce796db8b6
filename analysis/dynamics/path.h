#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "analysis/dynamics/tracks.h"

/// @file
/// The parts of the path of a particle that are correlated.
namespace vitrel {

/// A unit vector at every frame.
template <int Dim>
using DirectionSeries = std::array<FrameSeries, Dim>;

/// Returns the number of axes of a body that are followed. They are the long one of an ellipse; in space the figure
/// axis (orientation_tensor.h), and for bodies with three different axes also the middle and the short one.
template <int Dim>
std::size_t axis_count(const Configuration<Dim>& configuration);

/// Returns the vector α e of a rotation by α about e, 0 ≤ α ≤ π.
Vec3 rotation_vector(Quaternion turn);

/// The path of a particle and, if it is not round, its turns and axes.
///
/// In space the rotation vector is the sum of the rotations from frame to frame,
///
///     φ(t_k) = Σ_{l ≤ k} α_l e_l,   q_l q_{l−1}⁻¹ = (cos α_l/2, e_l sin α_l/2),   0 ≤ α_l ≤ π:
///
/// It is unbounded, as the angle is in the plane, and exact for a body that turns about a fixed axis by less than half
/// a turn between two frames. In the plane the same holds for files that do not count turns, and for directors with a
/// quarter turn in the place of half a turn.
template <int Dim>
struct Path {
  static constexpr std::size_t rotations = Dim == 2 ? 1 : 3;

  /// `axes` is given by axis_count. The numbers of the frames first, first + stride … lie one after the other, for
  /// first = 0, then 1 …: origins and ends of a time difference are then two pieces of memory.
  Path(Track<Dim> track, const ParticleShape<Dim>& shape, std::size_t axes, std::size_t stride = 1);

  bool is_rotor() const { return !directions.empty(); }
  /// Returns the place of the number of a frame.
  std::size_t place(std::size_t frame) const { return frame % stride * column + frame / stride; }

  std::size_t stride, column;
  std::array<FrameSeries, Dim> position;         ///< unwrapped
  std::array<FrameSeries, rotations> turn;       ///< the angle, or the rotation vector
  std::vector<DirectionSeries<Dim>> directions;  ///< directions of the axes
  /// Largest turn between two frames, if turns are not counted; for directors twice that.
  double largest_turn = 0;
};

/// Returns whether turns between frames can be told from longer ones the other way: the largest turn seen must be well
/// below half a turn.
inline bool turns_are_known(double largest_turn) {
  return largest_turn < 0.75 * std::numbers::pi;
}

}  // namespace vitrel
