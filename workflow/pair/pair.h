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
/// Overlap, gap and first contact of two hard bodies in free flight, over all images of the second one if there is
/// a periodic box.
namespace vitrel {

template <int Dim>
struct Pair {
  Flight<ParticleShape<Dim>> one, two;
  std::optional<PeriodicBox<Dim>> box;
  double horizon = 0;
  /// Scalene ellipsoids rotate by Euler's equations (core/geometry/tumbling_ellipsoid.h); all others keep their angular
  /// velocity.
  FreeRotation rotation = FreeRotation::euler;

  bool tumbles() const;
};

/// The pair of validated parameters, whose dimension is Dim.
template <int Dim>
Pair<Dim> pair_of(const PairParameters& parameters);

/// Whether the bodies overlap at time 0, by the exact criterion (core/state/check.h): a touch is none. Much faster than the
/// gap.
template <int Dim>
bool overlaps(const Pair<Dim>& pair);

/// The image of body 2 that is closest to body 1, or overlaps it most deeply.
template <int Dim>
struct PairGap {
  bool overlap = false;  ///< as `overlaps`
  /// The distance of the surfaces; of an overlap minus its depth, the shortest translation that undoes it (of
  /// crossed bodies a close upper bound of that). Good to rounding of the coordinates.
  double gap = 0;
  /// The factor by which both bodies, scaled about their centres, touch: √F of Perram and Wertheim
  /// (core/contact/perram_wertheim.h).
  double touching_scale = 0;
  /// Ψ, G₁ and G₂ of Vieillard-Baron; in space η₁ … η₅.
  std::conditional_t<Dim == 2, VieillardBaron<double>, EllipsoidEta<double>> criterion{};
  Shift<Dim> image = Shift<Dim>::Zero();  ///< body 2 is seen at its position + image ∘ L
  /// Unit vector from 1 to 2 along the shortest distance, and its ends on both surfaces; without meaning if they
  /// overlap.
  Vec<Dim> normal = Vec<Dim>::Zero(), point1 = Vec<Dim>::Zero(), point2 = Vec<Dim>::Zero();
};

/// After free flight for `time`.
template <int Dim>
PairGap<Dim> gap_at(const Pair<Dim>& pair, double time);

template <int Dim>
struct PairContact {
  Prediction<Dim> prediction;  ///< first_contact.h
  Shift<Dim> image = Shift<Dim>::Zero();
};

/// Answers for a pair without a box.
template <int Dim>
using PredictContact = std::function<Prediction<Dim>(const Pair<Dim>&)>;

/// The first contact that `predict` finds with any image. UserError if a body turns too often until the horizon.
template <int Dim>
PairContact<Dim> first_contact_of_images(const Pair<Dim>& pair, const PredictContact<Dim>& predict);

/// The first contact by the method of the engine (first_contact.h), never `not_converged`; `overlap` also if the
/// bodies touch at time 0 up to rounding.
template <int Dim>
PairContact<Dim> first_contact(const Pair<Dim>& pair);

}  // namespace vitrel
