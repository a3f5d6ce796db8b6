#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// The method of ghossein2013: the first root of η₁(t) at which two ellipsoids are externally tangent, that is (its
/// table 1, case 3) η₂ > 0, η₃ < 0 and η₅ > 0. Its case 4 requires η₁ = η₂ = 0, which rounded numbers never satisfy.
///
///   1. March over the bracket in steps of `tolerance` times its length (usually 1/100) until η₁ changes its sign
///      within a step.
///   2. Algorithm 748, the successor of Brent's method with no more evaluations, refines the root to double
///      precision. If the signs there are not those of a contact, the march continues.
///
/// Two roots within a step, which are the beginning and the end of a short overlap, leave no change of sign and are
/// missed. Contacts of spheres, and of parallel bodies of one shape, are missed too, because η₁ vanishes at all
/// times. The point and the normal come from the double root (ellipsoid_touch). Sources: ghossein2013,
/// core/contact/ellipsoid_eta.h.
Prediction3 eta_root(const EllipsoidCase& asked, double tolerance);

/// The first root of F(t) − 1 with the function F of Perram and Wertheim. The bracket is scanned in steps of
/// `tolerance` times its length (usually 1/100), and algorithm 748 refines within the first step that ends with F ≤
/// 1. An overlap between two steps is missed.
Prediction3 perram_wertheim_root(const EllipsoidCase& asked, double tolerance);

}  // namespace vitrel::bench
