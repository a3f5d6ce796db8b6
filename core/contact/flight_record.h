#pragma once

#include <cstddef>
#include <limits>
#include <type_traits>

#include "core/geometry/free_flight.h"
#include "core/geometry/tumbling_ellipsoid.h"

namespace vitrel {

namespace detail {

struct Empty {};

template <int dimension, bool rotates, bool tumbles>
struct alignas(64) FlightRecord {
  static constexpr bool has_rotation = rotates;

  struct Rotation {
    AngularVelocity<dimension> angular_velocity;
    /// The maximum Ω of |ω| of a tumbling body; |ω| of other bodies is constant.
    [[no_unique_address]] std::conditional_t<tumbles, double, Empty> max_angular_speed;
    Orientation<dimension> orientation;
  };

  Vec<dimension> position, velocity;
  double time = 0;  ///< time of position and orientation
  /// The contacts of the particle are known up to this time.
  double known_until = std::numeric_limits<double>::infinity();
  [[no_unique_address]] std::conditional_t<has_rotation, Rotation, Empty> rotation;

  Orientation<dimension> orientation() const {
    if constexpr (has_rotation)
      return rotation.orientation;
    else
      return Orientation<dimension>::Identity();
  }
  AngularVelocity<dimension> angular_velocity() const {
    if constexpr (has_rotation)
      return rotation.angular_velocity;
    else
      return AngularVelocity<dimension>::Zero();
  }
  Pose<dimension> pose() const { return {position, orientation()}; }
  /// Returns the pose at time t. (The pose of a tumbling body follows from its AsymmetricTop.)
  Pose<dimension> pose_at(double t) const requires(!tumbles) {
    if constexpr (has_rotation)
      return advanced(pose(), motion(), t - time);
    else
      return {position + (t - time) * velocity, orientation()};
  }
  Motion<dimension> motion() const { return {velocity, angular_velocity()}; }
  void set_pose(const Pose<dimension>& pose) {
    position = pose.position;
    if constexpr (has_rotation) rotation.orientation = orientation_of(pose);
  }
  void set_motion(const Motion<dimension>& motion) {
    velocity = motion.velocity;
    if constexpr (has_rotation) rotation.angular_velocity = motion.angular_velocity;
  }

  const double* numbers() const { return position.data(); }
};

}  // namespace detail

/// The data of a particle in flight that predictions read: one cache line, or two for ellipsoids. Its numbers are
/// contiguous, so that the records of several partners can be transposed in registers (simd_batch.h).
///
/// Spheres rotate uniformly and no event depends on their rotation, so it is not part of the record.
template <Body B>
using FlightRecord =
    detail::FlightRecord<B::dimension, B::dimension == 2 || !RoundBody<B>, tumbles<B>>;

/// Returns a record at time 0, or at the given time.
template <Body B>
FlightRecord<B> flight_record(const Pose<B::dimension>& pose, const Motion<B::dimension>& motion,
                              double time = 0,
                              double known_until = std::numeric_limits<double>::infinity()) {
  FlightRecord<B> record;
  record.time = time;
  record.known_until = known_until;
  record.set_pose(pose);
  record.set_motion(motion);
  return record;
}

/// The indices of the numbers of a record, counted from its first.
template <int Dim>
struct RecordLayout {
  static constexpr int position = 0, velocity = Dim, time = 2 * Dim, known_until = 2 * Dim + 1;
  static constexpr int angular_velocity = 2 * Dim + 2;
  static constexpr int max_angular_speed = angular_velocity + 3;  // tumbling bodies only
  static constexpr int orientation =
      angular_velocity + (Dim == 2 ? 1 : 4);  // quaternion: x, y, z, w
  static constexpr int translation_size = 2 * Dim + 2, size = Dim == 2 ? 8 : 16;
};
static_assert(sizeof(FlightRecord<Disk>) == 64 && sizeof(FlightRecord<Sphere>) == 64);
static_assert(sizeof(FlightRecord<Ellipse>) == 64 && sizeof(FlightRecord<Ellipsoid>) == 128);
static_assert(sizeof(FlightRecord<TumblingEllipsoid>) == 128);
static_assert(offsetof(FlightRecord<Ellipse>, rotation) == 6 * sizeof(double));
static_assert(offsetof(FlightRecord<Ellipsoid>, rotation) == 8 * sizeof(double));
static_assert(offsetof(FlightRecord<Ellipsoid>::Rotation, orientation) == 4 * sizeof(double));
static_assert(offsetof(FlightRecord<TumblingEllipsoid>::Rotation, max_angular_speed) ==
              3 * sizeof(double));

}  // namespace vitrel
