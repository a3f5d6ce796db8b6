#pragma once

#include "core/contact/first_look.h"

namespace vitrel::bench {

/// A first look that settles nothing and remembers nothing: every pair is searched.
class NoLowerBound : public detail::Urgencies<many> {
 public:
  using Shape = Ellipse;
  static constexpr int lanes = many;
  static constexpr bool is_exact = false;
  struct Memory {
    explicit(false) Memory(const Vec2& /*axis*/ = {}) {}
    friend Memory reversed(const Memory& memory) { return memory; }
  };

  NoLowerBound(const Outline<Ellipse>&, const Pose2&, const Motion2&, const CommonSize&, double) {}
  void set(int, const Pose2&, const Motion2&, const Outline<Ellipse>&, const Memory&, double) {}
  Memory memory(int) const { return {}; }
  void look(int count) { open(0, count); }
};

}  // namespace vitrel::bench
