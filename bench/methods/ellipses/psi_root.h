#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// The first root of the contact function Ψ(t) of Vieillard-Baron with the complete criterion (figure 3.15 of the
/// thesis). The bracket is scanned in steps of `tolerance` times its length (usually 1/100) for the first time at
/// which the pair is not disjoint. Algorithm 748 refines Ψ within that step to double precision, with −|Ψ| where the
/// pair overlaps. A contact shorter than a step can be missed. Ψ has a steep end and a flat one, which costs only
/// iterations. The normal and the point come from Perram and Wertheim.
Prediction2 psi_root(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench
