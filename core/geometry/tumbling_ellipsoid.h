#pragma once

#include "core/geometry/asymmetric_top.h"
#include "core/geometry/free_flight.h"
#include "core/geometry/growing.h"

namespace vitrel {

/// An ellipsoid that rotates by Euler's equations (asymmetric_top.h), whereas a plain `Ellipsoid` keeps its angular
/// velocity. Spheroids and spheres move identically as either type, but this type costs more. `motion` of a flight
/// holds the angular velocity at time 0.
struct TumblingEllipsoid {
  static constexpr int dimension = 3;
  Ellipsoid shape;

  double circumradius() const { return shape.circumradius(); }
  double inradius() const { return shape.inradius(); }
  double volume() const { return shape.volume(); }
  double max_support_rate() const { return shape.max_support_rate(); }
  bool is_round() const { return shape.is_round(); }
};

static_assert(Body<TumblingEllipsoid>);

template <>
struct ShapeOf<TumblingEllipsoid> {
  using type = Ellipsoid;
  static constexpr bool grows = false;
};

/// The rotation is known in closed form, so a flight may start at any time of a given top.
template <>
struct Flight<TumblingEllipsoid> {
  TumblingEllipsoid body;
  Pose3 pose;
  Motion3 motion;
  AsymmetricTop top;
  double top_time = 0;  ///< the top's time at time 0 of the flight

  Flight(const TumblingEllipsoid& ellipsoid, const Pose3& start, const Motion3& velocities)
      : Flight(ellipsoid, start, velocities,
               {ellipsoid.shape, start.orientation, velocities.angular_velocity}, 0) {}
  /// Takes a top whose state at `time` is that of `start` and `velocities`.
  Flight(const TumblingEllipsoid& ellipsoid, const Pose3& start, const Motion3& velocities,
         const AsymmetricTop& rotation, double time)
      : body(ellipsoid), pose(start), motion(velocities), top(rotation), top_time(time) {}
};

inline Pose3 pose_at(const Flight<TumblingEllipsoid>& flight, double time) {
  return {flight.pose.position + flight.motion.velocity * time,
          quaternion_of(flight.top.at(flight.top_time + time).axes)};
}

/// Bodies whose angular velocity changes in free flight.
template <class B>
inline constexpr bool tumbles = std::same_as<B, TumblingEllipsoid>;

}  // namespace vitrel
