#pragma once

#include <optional>

#include "bench/lab/methods/bracket.h"
#include "core/contact/first_contact.h"
#include "core/contact/perram_wertheim.h"
#include "core/contact/vieillard_baron.h"

/// What the methods have in common before and after their search.
namespace vitrel::lab {

/// The ellipse of a flight at a time. A point (size 0) is given a size that no result can feel, so
/// that no formula divides by zero.
Ellipse body_at(const Flight<GrowingEllipse>& flight, double time);
inline constexpr double smallest_size = 1e-30;

/// The complete criterion of Vieillard-Baron at a time.
VieillardBaron<double> vieillard_baron_at(const CollisionCase& asked, double time);
PerramWertheim<2> perram_wertheim_at(const CollisionCase& asked, double time);
bool overlaps_at_start(const CollisionCase& asked);

/// An answer that is no contact, with the number of steps or evaluations it took.
Prediction2 without_contact(Outcome outcome, int steps);
/// The contact with the normal along `outward`; not_converged if that is no direction.
Prediction2 contact_along(const Vec2& outward, double time, const Vec2& point, int steps);
/// The contact at a time known to be one, with the normal and point of Perram and Wertheim.
Prediction2 contact_at(const CollisionCase& asked, double time, int steps);

/// All numbers finite, semi-axes positive, sizes not negative. Methods answer not_converged
/// otherwise.
bool is_sound(const CollisionCase& asked);

/// The answer if no search is needed (unsound: not_converged; no contact possible: none;
/// overlapping at the start; a pair whose bracket is a single time, as of circles), else the
/// bracket to search.
struct Opening {
  std::optional<Prediction2> answer;
  Bracket bracket;
};
Opening open_search(const CollisionCase& asked);

}  // namespace vitrel::lab
