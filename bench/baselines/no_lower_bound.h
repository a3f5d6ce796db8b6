#pragma once

#include "core/contact/ellipse_contact_screen.h"

namespace vitrel::bench {

/// A contact screen that excludes no contact: every pair is searched.
class NoLowerBound : public detail::CandidateTimes {
 public:
  static constexpr int lanes = simd_width;

  NoLowerBound(const ShapeCoefficients<Ellipse>&, const Pose2&, const Motion2&, const CommonSize&,
               double) {}
  void set(int, const Pose2&, const Motion2&, const ShapeCoefficients<Ellipse>&,
           const WarmStart<Ellipse>&, double) {}
  WarmStart<Ellipse> warm_start(int) const { return {Vec2(1, 0)}; }
  void evaluate(int count) { set_times(0, count); }
};

}  // namespace vitrel::bench
