#include "mc/disjoint.h"

#include <algorithm>
#include <cmath>

#include "core/contact/pair.h"
#include "core/contact/perram_wertheim.h"
#include "core/neighbors/pairs.h"
#include "core/tolerances.h"

namespace vitrel {

double hard_margin(const Configuration2& configuration) {
  return tolerance::contact_gap(0.5 * configuration.box.lengths().maxCoeff() +
                                largest_circumradius(configuration));
}

bool clear_of_own_images(const PeriodicBox<2>& box, const Ellipse& shape, const Vec2& axis,
                         double margin) {
  bool clear = true;
  box.for_each_image(Vec2::Zero(), 2 * shape.circumradius() + margin,
                     [&](const Shift<2>& shift, const Vec2& d) {
                       if (shift.isZero() || !clear) return;
                       clear = separated(shape, axis, shape, axis, d, margin);
                     });
  return clear;
}

std::optional<std::pair<std::size_t, std::size_t>> find_overlap(
    const Configuration2& configuration) {
  const double margin = hard_margin(configuration);
  std::optional<std::pair<std::size_t, std::size_t>> found;
  for_each_pair(configuration, 1 + margin / largest_circumradius(configuration),
                [&](std::size_t i, std::size_t j, const Vec2& d) {
                  if (found) return;
                  if (!separated(configuration.shape[i], configuration.pose(i),
                                 configuration.shape[j], configuration.pose(j), d, margin))
                    found = {i, j};
                });
  return found;
}

double shrink_to_contact(const Configuration2& configuration, double lowest) {
  double factor = lowest;
  for_each_pair(configuration, 1 / lowest, [&](std::size_t i, std::size_t j, const Vec2& d) {
    const Ellipse& one = configuration.shape[i];
    const Ellipse& two = configuration.shape[j];
    // Circumcircles touch at a smaller factor than any found so far: no need to look closer.
    const double circles = one.circumradius() + two.circumradius();
    if (circles * circles < factor * factor * d.squaredNorm()) return;
    const double f =
        perram_wertheim(one, configuration.angle[i], two, configuration.angle[j], d).value;
    factor = std::max(factor, 1 / std::sqrt(f));
  });
  return factor;
}

void scale_box(Configuration2& configuration, const Vec2& factors) {
  configuration.box = PeriodicBox<2>(configuration.box.lengths().cwiseProduct(factors));
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    configuration.position[i] = configuration.position[i].cwiseProduct(factors);
    configuration.box.wrap(configuration.position[i], configuration.image[i]);
  }
}

void scale_box(Configuration2& configuration, double factor) {
  scale_box(configuration, Vec2(factor, factor));
}

void scale_to_packing_fraction(Configuration2& configuration, double packing_fraction) {
  scale_box(configuration, std::sqrt(vitrel::packing_fraction(configuration) / packing_fraction));
}

}  // namespace vitrel
