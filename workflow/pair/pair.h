#pragma once

#include <functional>
#include <optional>
#include <type_traits>

#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/ellipsoid_eta.h"
#include "core/contact/first_contact.h"
#include "core/state/configuration.h"
#include "workflow/pair/pair_parameters.h"

/// @file
/// Overlap, gap and first contact of two hard bodies in free flight. In a periodic box, all images of the second body
/// count.
namespace vitrel {

template <int Dim>
struct Pair {
  Flight<ParticleShape<Dim>> one, two;
  std::optional<PeriodicBox<Dim>> box;
  double horizon = 0;
  /// With `euler`, scalene ellipsoids rotate by Euler's equations (core/geometry/tumbling_ellipsoid.h). All other
  /// bodies keep their angular velocity.
  FreeRotation rotation = FreeRotation::euler;

  bool tumbles() const;
};

/// Builds the pair from validated parameters of dimension Dim.
template <int Dim>
Pair<Dim> pair_of(const PairParameters& parameters);

/// Whether the bodies overlap at time 0 by the exact criterion (core/state/check.h), for which bodies that touch do
/// not overlap. Much faster than gap_at.
template <int Dim>
bool overlaps(const Pair<Dim>& pair);

/// The gap to the image of body 2 that is closest to body 1, or overlaps it most deeply.
template <int Dim>
struct PairGap {
  bool overlap = false;  ///< by the criterion of `overlaps`
  /// The distance of the surfaces. If the bodies overlap, it is minus the depth, which is the shortest translation
  /// that separates them (for crossed bodies, a close upper bound of it). It is accurate to the rounding of the
  /// coordinates.
  double gap = 0;
  /// The factor by which both bodies, scaled about their centres, would touch: √F of Perram and Wertheim
  /// (core/contact/perram_wertheim.h).
  double touching_scale = 0;
  /// Ψ, G₁ and G₂ of Vieillard-Baron in the plane; η₁ … η₅ in space.
  std::conditional_t<Dim == 2, VieillardBaron<double>, EllipsoidEta<double>> criterion{};
  Shift<Dim> image = Shift<Dim>::Zero();  ///< this image of body 2 lies at its position + image ∘ L
  /// Unit vector from 1 to 2 along the shortest distance, and the points where that distance meets the surfaces. They
  /// have no meaning if the bodies overlap.
  Vec<Dim> normal = Vec<Dim>::Zero(), point1 = Vec<Dim>::Zero(), point2 = Vec<Dim>::Zero();
};

/// The gap after free flight for `time`.
template <int Dim>
PairGap<Dim> gap_at(const Pair<Dim>& pair, double time);

template <int Dim>
struct PairContact {
  Prediction<Dim> prediction;  ///< defined in first_contact.h
  Shift<Dim> image = Shift<Dim>::Zero();
};

/// Predicts the first contact of a pair without a box.
template <int Dim>
using PredictContact = std::function<Prediction<Dim>(const Pair<Dim>&)>;

/// The first contact that `predict` finds with any image. Throws UserError if a body turns too often before the
/// horizon.
template <int Dim>
PairContact<Dim> first_contact_of_images(const Pair<Dim>& pair, const PredictContact<Dim>& predict);

/// The first contact by the method of the engine (first_contact.h); the outcome is never `not_converged`. The outcome
/// is `overlap` also if the bodies touch at time 0 up to rounding.
template <int Dim>
PairContact<Dim> first_contact(const Pair<Dim>& pair);

}  // namespace vitrel
