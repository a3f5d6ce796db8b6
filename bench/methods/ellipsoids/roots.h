#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// The method of the article on packing: the first root of η₁(t) at which two ellipsoids are externally
/// tangent, that is (its table 1, case 3) η₂ > 0, η₃ < 0 and η₅ > 0. Case 4 wants η₁ = η₂ = 0, which no
/// rounded number ever says.
///
///   1. March over the bracket in steps of `tolerance` times its length (usual 1/100): η₁ changes its sign
///      within a step.
///   2. Algorithm 748, which succeeds Brent's and needs no more evaluations, refines the root to double
///      precision. If the signs there are not those of a contact, go on.
///
/// Two roots within a step, the begin and the end of a short overlap, leave no change of sign and are
/// missed; so is the contact of spheres and of parallel bodies of one shape, where η₁ vanishes at all
/// times. Point and normal by the double root (ellipsoid_touch). Sources: ghossein2013, core/contact/
/// ellipsoid_eta.h.
Prediction3 eta_root(const EllipsoidCase& asked, double tolerance);

/// The first root of F(t) − 1, F the function of Perram and Wertheim: a scan of the bracket in steps of
/// `tolerance` times its length (usual 1/100), and algorithm 748 within the first step that ends with
/// F ≤ 1. An overlap between two steps is missed.
Prediction3 perram_wertheim_root(const EllipsoidCase& asked, double tolerance);

}  // namespace vitrel::bench
