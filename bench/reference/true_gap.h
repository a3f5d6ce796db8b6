#pragma once

#include "core/geometry/growing.h"

namespace vitrel::bench {

/// Where the surfaces of two ellipses are closest.
struct ClosestSurfaces {
  long double gap = 0;             ///< their distance, or minus the depth of their overlap
  Vec2 normal = Vec2::Zero();      ///< unit vector from 1 to 2
  long double approach_speed = 0;  ///< of the surfaces along the normal, growth included
};

/// The distance of two ellipses at `time`, in 80-bit arithmetic, by the largest support gap: with n
/// at angle φ and h the support functions,
///     g(φ) = n·d − h₁ − h₂,   g'' = −(g + ρ₁ + ρ₂),   ρ = a²b²/h³,
/// max g > 0 is the distance, max g < 0 minus the smallest shift that separates the ellipses. There
/// may be several maxima, all where g + ρ₁ + ρ₂ ≥ 0.
///
/// Branch and bound over the circle of directions: a piece goes if the bound
/// g + |g'| w + ½ (|d| + h₁ + h₂) w² on its half-width w says that it holds nothing better than
/// what is known; if g + ρ₁ + ρ₂ > 0 is certain all over it, Newton's method, kept inside a
/// bracket, finds its one maximum; else it is halved. (Deep inside an overlap, where a maximum has
/// g + ρ₁ + ρ₂ = 0, the depth is found to 1e-3 only.)
///
/// The approach speed is −∂g/∂t at fixed n: the maximum does not feel the turning of n.
ClosestSurfaces closest_surfaces(const Flight<GrowingEllipse>& one,
                                 const Flight<GrowingEllipse>& two, long double time);

/// Its gap: positive exactly for disjoint surfaces.
long double true_gap(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two,
                     long double time);

}  // namespace vitrel::bench
