#pragma once

#include "bench/overlap/overlap_case.h"

/// @file
/// The contact function of Perram and Wertheim with a limited number of steps, as in programs that call a pair
/// disjoint if they have found no answer by then.
namespace vitrel::bench {

/// Bisects for the maximum of F(λ) (perram_wertheim.h). The pair is disjoint if F > 1 anywhere. It overlaps if the
/// tangents at both ends of the interval meet below 1, because F is concave. If neither is decided after `steps`, the
/// pair counts as disjoint.
template <int Dim>
bool disjoint_or_undecided(const OverlapCase<Dim>& asked, int steps) {
  const auto matrix = [](const BodyIn<Dim>& body, const PoseIn<Dim>& pose) {
    if constexpr (Dim == 2)
      return shape_matrix(body, pose.angle);
    else
      return shape_matrix(body, pose.orientation);
  };
  const auto one = matrix(asked.one, asked.pose1), two = matrix(asked.two, asked.pose2);
  const Vec<Dim> d = asked.between_centres();
  struct Point {
    double lambda, value, slope;
  };
  const auto at = [&](double lambda) -> Point {
    const auto mixed = ((1 - lambda) * one + lambda * two).eval();
    const Vec<Dim> y = mixed.inverse() * d;
    return {lambda, lambda * (1 - lambda) * d.dot(y),
            (1 - 2 * lambda) * d.dot(y) - lambda * (1 - lambda) * y.dot((two - one) * y)};
  };
  Point low = at(0), high = at(1);
  for (int step = 0; step < steps; ++step) {
    const Point middle = at(0.5 * (low.lambda + high.lambda));
    if (middle.value > 1) return true;
    (middle.slope > 0 ? low : high) = middle;
    const double meet =
        (high.value - low.value + low.slope * low.lambda - high.slope * high.lambda) /
        (low.slope - high.slope);
    if (low.value + low.slope * (meet - low.lambda) < 1) return false;
  }
  return true;
}

}  // namespace vitrel::bench
