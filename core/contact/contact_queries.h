#pragma once

#include "core/contact/ellipse_gap.h"
#include "core/contact/ellipsoid_gap.h"
#include "core/contact/first_contact.h"

/// @file
/// These functions give the separation, the support gap and a surface point for given poses, with one signature for all
/// bodies. Neighbour lists and the event loop use them. d points from centre 1 to centre 2 and includes the image
/// shift.
namespace vitrel {

inline bool separated(const Ellipse& one, const Pose2& pose1, const Ellipse& two,
                      const Pose2& pose2, const Vec2& d, double margin) {
  const double outer = one.a + two.a + margin;
  if (squared_norm(d) >= outer * outer) return true;
  return separated(one, direction(pose1.angle), two, direction(pose2.angle), d, margin);
}

template <int Dim>
bool separated(const Ball<Dim>& one, const Pose<Dim>&, const Ball<Dim>& two, const Pose<Dim>&,
               const Vec<Dim>& d, double margin) {
  const double reach = one.radius + two.radius + margin;
  return squared_norm(d) >= reach * reach;
}

inline bool separated(const Ellipsoid& one, const Pose3& pose1, const Ellipsoid& two,
                      const Pose3& pose2, const Vec3& d, double margin) {
  return separated(one, pose1.orientation, two, pose2.orientation, d, margin);
}

inline SupportGap support_gap(const Ellipse& one, const Pose2& pose1, const Ellipse& two,
                              const Pose2& pose2, const Vec2& d) {
  return support_gap(one, pose1.angle, two, pose2.angle, d);
}

inline SupportGap3 support_gap(const Ellipsoid& one, const Pose3& pose1, const Ellipsoid& two,
                               const Pose3& pose2, const Vec3& d) {
  return support_gap(one, pose1.orientation, two, pose2.orientation, d);
}

/// The surface point with outward normal n, relative to the centre.
inline Vec2 surface_point(const Ellipse& body, const Pose2& pose, const Vec2& n) {
  return surface_point(body, direction(pose.angle), n);
}

template <int Dim>
Vec<Dim> surface_point(const Ball<Dim>& body, const Pose<Dim>&, const Vec<Dim>& n) {
  return body.radius * n;
}

inline Vec3 surface_point(const Ellipsoid& body, const Pose3& pose, const Vec3& n) {
  return surface_point(body, pose.orientation, n);
}

}  // namespace vitrel
