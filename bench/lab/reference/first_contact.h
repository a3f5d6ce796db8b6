#pragma once

#include "core/geometry/ellipse.h"

namespace vitrel::lab {

/// The true first contact of two ellipses in free flight, slowly but with a guarantee, in 80-bit
/// arithmetic; it shares no code with the methods it judges.
///
/// Contact is the first root of the Vieillard-Baron function Ψ(t): a pair that starts disjoint stays so
/// as long as Ψ > 0, since crossed and contained pairs, which have Ψ > 0 too, are reached through Ψ = 0
/// only. The horizon is searched from the left. Over a piece of it, interval arithmetic with two
/// derivatives encloses
///     Ψ(t) ∈ Ψ(m) + Ψ'(m)(t − m) + ½ Ψ''(piece)(t − m)²,
/// m its middle. A piece is passed if that is positive throughout; if Ψ' is negative throughout and Ψ
/// changes sign, the root is bisected to the last bit; any other piece is halved. There is no fixed scan
/// that a short overlap could slip through.
///
/// `undecided`: a piece could be neither passed nor halved further: the surfaces touch, or miss each
/// other by less than about 1e-17 of their size, without crossing. `time` then is where.
struct TrueContact {
  enum class Outcome { contact, none, undecided, overlap_at_start };
  Outcome outcome = Outcome::none;
  long double time = 0;
  int pieces = 0;  ///< pieces of the horizon looked at
};

TrueContact true_first_contact(const Flight<Ellipse>& one, const Flight<Ellipse>& two,
                               double horizon);

}  // namespace vitrel::lab
