#pragma once

#include <algorithm>
#include <optional>

#include "bench/methods/bracket.h"
#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/ellipsoid_eta.h"
#include "core/contact/first_contact.h"
#include "core/contact/perram_wertheim.h"

/// @file
/// What the methods have in common before and after their search.
namespace vitrel::bench {

inline constexpr double smallest_size = 1e-30;
/// The shape of a flight at a time. A point (size 0) is given a size that no result can feel, so
/// that no formula divides by zero.
template <class Shape>
Shape body_at(const Flight<Growing<Shape>>& flight, double time) {
  return scaled(flight.body.shape, std::max(flight.body.size_at(time), smallest_size));
}

/// The pose of body 0 or 1.
Pose2 pose_at(const CollisionCase& asked, int body, double time);
Pose3 pose_at(const EllipsoidCase& asked, int body, double time);

/// The complete criterion of Vieillard-Baron at a time.
VieillardBaron<double> vieillard_baron_at(const CollisionCase& asked, double time);
/// The completed criterion of η₁ … η₅ at a time.
EllipsoidEta<double> ellipsoid_eta_at(const EllipsoidCase& asked, double time);
template <int Dim>
PerramWertheim<Dim> perram_wertheim_at(const CollisionCaseOf<Dim>& asked, double time);
template <int Dim>
bool overlaps_at_start(const CollisionCaseOf<Dim>& asked);

/// An answer that is no contact, with the number of steps or evaluations it took.
template <int Dim = 2>
Prediction<Dim> without_contact(Outcome outcome, int steps) {
  return {outcome, 0, Vec<Dim>::Zero(), Vec<Dim>::Zero(), steps};
}
/// The contact with the normal along `outward`; not_converged if that is no direction.
Prediction2 contact_along(const Vec2& outward, double time, const Vec2& point, int steps);
/// The contact at a time known to be one, with the normal and point of Perram and Wertheim.
template <int Dim>
Prediction<Dim> contact_at(const CollisionCaseOf<Dim>& asked, double time, int steps);

/// All numbers finite, semi-axes positive, sizes not negative. Methods answer not_converged
/// otherwise.
template <int Dim>
bool is_sound(const CollisionCaseOf<Dim>& asked);

/// The answer if no search is needed (unsound: not_converged; no contact possible: none;
/// overlapping at the start; a pair whose bracket is a single time, as of circles), else the
/// bracket to search.
template <int Dim>
struct OpeningOf {
  std::optional<Prediction<Dim>> answer;
  Bracket bracket;
};
using Opening = OpeningOf<2>;
template <int Dim>
OpeningOf<Dim> open_search(const CollisionCaseOf<Dim>& asked);

}  // namespace vitrel::bench
