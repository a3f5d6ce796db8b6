#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// The function of Perram and Wertheim at a time, with its slope in time at fixed λ, which is also the slope of the
/// maximum over λ. With y = C⁻¹d,
///     dF/dt = λ(1−λ)(2 v·y − yᵀ Ċ y),   Ċ = (1−λ) Σ̇₁ + λ Σ̇₂,
///     yᵀ Σ̇ y = 2 ω (u·y)(p·y)(a² − b²) + 2 (ṡ/s) yᵀ Σ y,
/// where u is along a and p is u turned by +90°.
struct PerramWertheimRate {
  double value;  ///< F
  double slope;  ///< dF/dt
};
PerramWertheimRate perram_wertheim_rate(const CollisionCase& asked, double time);

/// The first root of F(t) − 1 by the method of Donev, Torquato and Stillinger (2005).
///
///   1. March over the bracket in steps of `tolerance` times its length (usually 1/20).
///   2. If F ≤ 1 at a sample, the root lies within the last step.
///   3. If F falls at one sample and rises at the next, the cubic through values and slopes is minimised. While its
///      minimum is below 1, F is evaluated there, and either the root is found or the interval is reduced to the part
///      that still dips, at most ten times.
///   4. Algorithm 748 refines the root to double precision.
///
/// A dip between samples that the slopes do not show is missed. Source: donev2005.
Prediction2 perram_wertheim_root(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench
