#pragma once

#include <algorithm>
#include <optional>

#include "bench/methods/bracket.h"
#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/ellipsoid_eta.h"
#include "core/contact/first_contact.h"
#include "core/contact/perram_wertheim.h"

/// @file
/// The steps before and after the search that all methods share.
namespace vitrel::bench {

inline constexpr double smallest_size = 1e-30;
/// The shape of a flight at a time. A point (size 0) gets a size that is too small to affect any result, so that no
/// formula divides by zero.
template <class Shape>
Shape body_at(const Flight<Growing<Shape>>& flight, double time) {
  return scaled(flight.body.shape, std::max(flight.body.size_at(time), smallest_size));
}

/// The pose of body 0 or 1 at a time.
Pose2 pose_at(const CollisionCase& asked, int body, double time);
Pose3 pose_at(const EllipsoidCase& asked, int body, double time);

/// Evaluates the complete criterion of Vieillard-Baron at a time.
VieillardBaron<double> vieillard_baron_at(const CollisionCase& asked, double time);
/// Evaluates the completed criterion of η₁ … η₅ at a time.
EllipsoidEta<double> ellipsoid_eta_at(const EllipsoidCase& asked, double time);
template <int Dim>
PerramWertheim<Dim> perram_wertheim_at(const CollisionCaseOf<Dim>& asked, double time);
template <int Dim>
bool overlaps_at_start(const CollisionCaseOf<Dim>& asked);

/// An answer other than a contact, with the number of steps or evaluations that it took.
template <int Dim = 2>
Prediction<Dim> without_contact(Outcome outcome, int steps) {
  return {outcome, 0, Vec<Dim>::Zero(), Vec<Dim>::Zero(), steps};
}
/// A contact whose normal is along `outward`; not_converged if `outward` has no direction.
Prediction2 contact_along(const Vec2& outward, double time, const Vec2& point, int steps);
/// The contact at a time at which the bodies are known to touch, with the normal and point of Perram and Wertheim.
template <int Dim>
Prediction<Dim> contact_at(const CollisionCaseOf<Dim>& asked, double time, int steps);

/// Whether all numbers are finite, semi-axes positive and sizes not negative. Methods answer not_converged otherwise.
template <int Dim>
bool is_sound(const CollisionCaseOf<Dim>& asked);

/// The answer if no search is needed, else the bracket to search. No search is needed for unsound numbers
/// (not_converged), if no contact is possible (none), if the pair overlaps at the start, and if the bracket is a
/// single time, as for circles.
template <int Dim>
struct OpeningOf {
  std::optional<Prediction<Dim>> answer;
  Bracket bracket;
};
using Opening = OpeningOf<2>;
template <int Dim>
OpeningOf<Dim> open_search(const CollisionCaseOf<Dim>& asked);

}  // namespace vitrel::bench
