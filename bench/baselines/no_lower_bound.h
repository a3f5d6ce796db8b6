#pragma once

#include "core/contact/ellipse_contact_screen.h"

namespace vitrel::bench {

/// A contact screen that excludes no contact: every pair is searched.
template <Body B>
class NoLowerBound : public detail::CandidateTimes<2 * simd_width> {
 public:
  static constexpr int lanes = 2 * simd_width;

  NoLowerBound(const ShapeCoefficients<Ellipse>&, const FlightRecord<B>&, double now,
               const CommonSize&, double)
      : now_(now) {}
  void set_shape(int, const ShapeCoefficients<Ellipse>&) {}
  void load(const FlightRecord<B>* const (&partner)[lanes], const WarmStart<B>* const (&)[lanes],
            double latest) {
    for (int k = 0; k < lanes; ++k) known_until_.set(k, partner[k]->known_until);
    latest_ = latest;
  }
  WarmStart<B> warm_start(int) const { return {Vec2(1, 0)}; }
  void evaluate(int count) {
    set_times(0., detail::horizon_of(known_until_, latest_, now_), count);
  }

 private:
  double now_, latest_ = 0;
  Simd<lanes> known_until_;
};

}  // namespace vitrel::bench
