#pragma once

#include "core/contact/contact_screen.h"

namespace vitrel::bench {

/// A first look that settles nothing and remembers nothing: every pair is searched.
class NoLowerBound : public detail::CandidateTimes<many> {
 public:
  using Shape = Ellipse;
  static constexpr int lanes = many;
  static constexpr bool is_exact = false;
  struct Memory {
    explicit(false) Memory(const Vec2& /*axis*/ = {}) {}
    friend Memory reversed(const Memory& memory) { return memory; }
  };

  NoLowerBound(const ShapeCoefficients<Ellipse>&, const Pose2&, const Motion2&, const CommonSize&,
               double) {}
  void set(int, const Pose2&, const Motion2&, const ShapeCoefficients<Ellipse>&, const Memory&,
           double) {}
  Memory memory(int) const { return {}; }
  void look(int count) { open(0, count); }
};

}  // namespace vitrel::bench
