#pragma once

#include <algorithm>

#include "core/contact/gap_search.h"

namespace vitrel {

/// The common part of a pair of ellipses and of a pair of ellipsoids in free flight, possibly growing.
template <class Pair>
class FlyingPair {
  using Vector = decltype(Pair::d);

 public:
  const Vector& d0() const { return d0_; }
  const Vector& v() const { return v_; }
  /// The sum of the circumradii at time 0, and its rate of growth.
  double reach() const { return reduce(circumradius_ * size0_); }
  double reach_growth() const { return reduce(circumradius_ * growth_); }
  /// The time scale of growth: the time in which the growing bodies together grow by the gap plus their present
  /// circumradii, infinite if none grows.
  double doubling_time(double gap) const {
    return (reduce(circumradius_ * pair_.size) + gap) / reduce(circumradius_ * max(growth_, 0));
  }

  /// Returns a time in which no size changes by more than a thousandth.
  double short_time() const {
    return std::min(time_of_little_growth(pair_.size[0], growth_[0]),
                    time_of_little_growth(pair_.size[1], growth_[1]));
  }

  double time() const { return time_; }

  auto initial_axis() const { return detail::initial_axis(pair_); }
  auto find_separating_axis() const { return detail::find_separating_axis(pair_); }
  void polish_axis(auto& n, const auto& here) const { detail::polish_axis(pair_, n, here); }

 protected:
  template <class B>
  FlyingPair(const Flight<B>& one, const Flight<B>& two)
      : d0_(two.pose.position - one.pose.position),
        v_(two.motion.velocity - one.motion.velocity),
        size0_(size_of(one.body), size_of(two.body)),
        growth_(growth_of(one.body), growth_of(two.body)),
        circumradius_(shape_of(one.body).circumradius(), shape_of(two.body).circumradius()) {
    pair_.size = size0_;
  }

  static const auto& shape_of(const auto& body) {
    if constexpr (requires { body.shape; })
      return body.shape;
    else
      return body;
  }

  template <bool grows>
  void place_centres(double time) {
    time_ = time;
    pair_.d = d0_ + v_ * time;
    if constexpr (grows) pair_.size = size0_ + growth_ * time;
  }

  Vector d0_, v_;
  SimdPair size0_, growth_, circumradius_;
  double time_ = 0;
  Pair pair_;  // the pair at time_

 private:
  template <class B>
  static double size_of(const B& body) {
    if constexpr (grows<B>) return body.size;
    return 1;
  }
  template <class B>
  static double growth_of(const B& body) {
    if constexpr (grows<B>) return body.growth_rate;
    return 0;
  }
};

}  // namespace vitrel
