#include "mc/disjoint.h"

#include <algorithm>
#include <cmath>

#include "core/contact/pair.h"
#include "core/contact/perram_wertheim.h"
#include "core/tolerances.h"

namespace vitrel {

double hard_margin(const Configuration2& configuration) {
  return tolerance::contact_gap(0.5 * configuration.box.lengths().maxCoeff() +
                                largest_circumradius(configuration));
}

CellGrid make_cells(const Configuration2& configuration) {
  CellGrid cells(configuration.box, 2 * largest_circumradius(configuration), configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i) cells.insert(i, configuration.position[i]);
  return cells;
}

std::optional<std::pair<std::size_t, std::size_t>> find_overlap(
    const Configuration2& configuration) {
  const CellGrid cells = make_cells(configuration);
  const double largest = largest_circumradius(configuration);
  const double margin = hard_margin(configuration);
  std::optional<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < configuration.size() && !found; ++i)
    for_each_candidate(configuration, cells, i, configuration.position[i], largest, margin,
                       [&](std::size_t j, const Shift<2>&, const Vec2& d) {
                         if (found || j < i) return;
                         if (!separated(configuration.shape[i], configuration.pose(i),
                                        configuration.shape[j], configuration.pose(j), d, margin))
                           found = {i, j};
                       });
  return found;
}

double shrink_to_contact(const Configuration2& configuration, double lowest) {
  const CellGrid cells = make_cells(configuration);
  const double largest = largest_circumradius(configuration);
  double factor = lowest;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const double reach = configuration.shape[i].circumradius() + largest;
    for_each_candidate(configuration, cells, i, configuration.position[i], largest,
                       reach * (1 / lowest - 1),
                       [&](std::size_t j, const Shift<2>&, const Vec2& d) {
                         const double circles = configuration.shape[i].circumradius() +
                                                configuration.shape[j].circumradius();
                         // Circumcircles touch at a smaller factor than any found so far: no need
                         // to look closer.
                         if (j < i || circles * circles < factor * factor * d.squaredNorm()) return;
                         const PerramWertheim touch =
                             perram_wertheim(configuration.shape[i], configuration.angle[i],
                                             configuration.shape[j], configuration.angle[j], d);
                         factor = std::max(factor, 1 / std::sqrt(touch.value));
                       });
  }
  return factor;
}

void scale_box(Configuration2& configuration, double factor) {
  configuration.box = PeriodicBox<2>(configuration.box.lengths() * factor);
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    configuration.position[i] *= factor;
    configuration.box.wrap(configuration.position[i], configuration.image[i]);
  }
}

void scale_to_packing_fraction(Configuration2& configuration, double packing_fraction) {
  scale_box(configuration, std::sqrt(vitrel::packing_fraction(configuration) / packing_fraction));
}

}  // namespace vitrel
