#pragma once

#include <optional>
#include <utility>

#include "core/elementary.h"
#include "core/state/configuration.h"

/// @file
/// The hard-core constraint of Monte Carlo: all particles at least a margin apart.
namespace vitrel {

/// The margin that Monte Carlo keeps between surfaces: the contact gap of the box and its longest particle
/// (tolerances.h), so that rounded coordinates never overlap.
template <int Dim>
double hard_margin(const Configuration<Dim>& configuration);

/// Whether a body at rest (resting_bodies.h) keeps the margin to its own periodic images.
template <int Dim, class Body>
bool clear_of_periodic_images(const PeriodicBox<Dim>& box, const Body& body, double margin) {
  bool clear = true;
  box.for_each_image(Vec<Dim>::Zero(), 2 * body.shape.circumradius() + margin,
                     [&](const Shift<Dim>& shift, const Vec<Dim>& d) {
                       if (shift.isZero() || !clear) return;
                       clear = separated(body, body, d, margin);
                     });
  return clear;
}

/// The first pair closer than the margin, if any.
template <int Dim>
std::optional<std::pair<std::size_t, std::size_t>> find_overlap(
    const Configuration<Dim>& configuration);

/// The factor by which the box and all positions may shrink until the first pair touches, at least `lowest`; 1 or more
/// if a pair already touches or overlaps. From max F = μ² of each pair (perram_wertheim.h): the pair touches at 1/μ.
template <int Dim>
double shrink_to_contact(const Configuration<Dim>& configuration, double lowest);

/// Scales the sides of the box and all positions by these factors; shapes stay.
template <int Dim>
void scale_box(Configuration<Dim>& configuration, const Vec<Dim>& factors) {
  configuration.box = PeriodicBox<Dim>(configuration.box.lengths().cwiseProduct(factors));
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    configuration.position[i] = configuration.position[i].cwiseProduct(factors);
    configuration.box.wrap(configuration.position[i], configuration.image[i]);
  }
}
/// The same with one factor for all sides.
template <int Dim>
void scale_box(Configuration<Dim>& configuration, double factor) {
  scale_box(configuration, Vec<Dim>(Vec<Dim>::Constant(factor)));
}

/// Scales to this packing fraction exactly (to rounding).
template <int Dim>
void scale_to_packing_fraction(Configuration<Dim>& configuration, double packing_fraction) {
  const double ratio = vitrel::packing_fraction(configuration) / packing_fraction;
  scale_box(configuration, root(ratio, Dim));
}

}  // namespace vitrel
