#pragma once

#include "core/contact/first_contact.h"
#include "core/contact/support_gap.h"

/// The contact questions asked of poses, in one form for every body, so that neighbour lists and
/// the event loop are written once. d runs from centre 1 to centre 2, the image shift included.
namespace vitrel {

inline bool separated(const Ellipse& one, const Pose2& pose1, const Ellipse& two,
                      const Pose2& pose2, const Vec2& d, double margin) {
  const double outer = one.a + two.a + margin;
  if (d.squaredNorm() >= outer * outer) return true;
  return separated(one, direction(pose1.angle), two, direction(pose2.angle), d, margin);
}

inline bool separated(const Disk& one, const Pose2&, const Disk& two, const Pose2&, const Vec2& d,
                      double margin) {
  const double reach = one.radius + two.radius + margin;
  return d.squaredNorm() >= reach * reach;
}

/// The gap along a good axis, a lower bound of the largest, and that axis: one that shows a gap of
/// `enough`, or else the best to a few steps of Newton's method.
inline SupportGap gap_along_good_axis(const Ellipse& one, const Pose2& pose1, const Ellipse& two,
                                      const Pose2& pose2, const Vec2& d, double enough) {
  return gap_along_good_axis(one, pose1.angle, two, pose2.angle, d, enough);
}

inline SupportGap gap_along_good_axis(const Disk& one, const Pose2&, const Disk& two, const Pose2&,
                                      const Vec2& d, double /*enough*/) {
  const double distance = d.norm();
  return {distance - one.radius - two.radius, d / distance};
}

inline SupportGap support_gap(const Ellipse& one, const Pose2& pose1, const Ellipse& two,
                              const Pose2& pose2, const Vec2& d) {
  return support_gap(one, pose1.angle, two, pose2.angle, d);
}

/// The surface point with outward normal n, relative to the centre.
inline Vec2 surface_point(const Ellipse& body, const Pose2& pose, const Vec2& n) {
  return surface_point(body, direction(pose.angle), n);
}

inline Vec2 surface_point(const Disk& body, const Pose2&, const Vec2& n) {
  return body.radius * n;
}

}  // namespace vitrel
