#pragma once

#include "core/contact/ellipse_contact_screen.h"

namespace vitrel::bench {

/// A contact screen that excludes no contact and stores no warm start: every pair is searched.
class NoLowerBound : public detail::CandidateTimes<simd_width> {
 public:
  using Shape = Ellipse;
  static constexpr int lanes = simd_width;
  static constexpr bool is_exact = false;
  struct WarmStart {
    explicit(false) WarmStart(const Vec2& /*axis*/ = {}) {}
    friend WarmStart reversed(const WarmStart& warm_start) { return warm_start; }
  };

  NoLowerBound(const ShapeCoefficients<Ellipse>&, const Pose2&, const Motion2&, const CommonSize&,
               double) {}
  void set(int, const Pose2&, const Motion2&, const ShapeCoefficients<Ellipse>&, const WarmStart&,
           double) {}
  WarmStart warm_start(int) const { return {}; }
  void evaluate(int count) { set_times(0, count); }
};

}  // namespace vitrel::bench
