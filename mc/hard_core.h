#pragma once

#include <optional>
#include <utility>

#include "core/elementary.h"
#include "core/state/configuration.h"

/// @file
/// The hard-core constraint of Monte Carlo: all particles are at least a margin apart.
namespace vitrel {

/// Returns the margin that Monte Carlo keeps between surfaces: the contact gap of the box and its longest particle
/// (tolerances.h), so that rounded coordinates never overlap.
template <int Dim>
double hard_margin(const Configuration<Dim>& configuration);

/// Returns whether a body at rest (resting_bodies.h) keeps the margin to its own periodic images.
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

/// Returns the first pair closer than the margin, if any.
template <int Dim>
std::optional<std::pair<std::size_t, std::size_t>> find_overlap(
    const Configuration<Dim>& configuration);

/// Returns the factor by which the box and all positions may shrink until the first pair touches. It is at least
/// `lowest`, and 1 or more if a pair already touches or overlaps. It follows from max F = μ² of each pair
/// (perram_wertheim.h), which touches at 1/μ.
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
/// Scales all sides of the box and all positions by one factor; shapes stay.
template <int Dim>
void scale_box(Configuration<Dim>& configuration, double factor) {
  scale_box(configuration, Vec<Dim>(Vec<Dim>::Constant(factor)));
}

/// Scales the box and all positions to this packing fraction, up to rounding.
template <int Dim>
void scale_to_packing_fraction(Configuration<Dim>& configuration, double packing_fraction) {
  const double ratio = vitrel::packing_fraction(configuration) / packing_fraction;
  scale_box(configuration, root(ratio, Dim));
}

}  // namespace vitrel
