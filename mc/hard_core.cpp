#include "mc/hard_core.h"

#include <algorithm>
#include <cmath>

#include "core/contact/contact_queries.h"
#include "core/contact/perram_wertheim.h"
#include "core/neighbors/pairs.h"
#include "core/tolerances.h"

namespace vitrel {

template <int Dim>
double hard_margin(const Configuration<Dim>& configuration) {
  return tolerance::contact_gap(0.5 * configuration.box.lengths().maxCoeff() +
                                largest_circumradius(configuration));
}

template <int Dim>
std::optional<std::pair<std::size_t, std::size_t>> find_overlap(
    const Configuration<Dim>& configuration) {
  const double margin = hard_margin(configuration);
  std::optional<std::pair<std::size_t, std::size_t>> found;
  for_each_pair(configuration, 1 + margin / largest_circumradius(configuration),
                [&](std::size_t i, std::size_t j, const Vec<Dim>& d) {
                  if (found) return;
                  if (!separated(configuration.shape[i], configuration.pose(i),
                                 configuration.shape[j], configuration.pose(j), d, margin))
                    found = {i, j};
                });
  return found;
}

template <int Dim>
double shrink_to_contact(const Configuration<Dim>& configuration, double lowest) {
  double factor = lowest;
  for_each_pair(configuration, 1 / lowest, [&](std::size_t i, std::size_t j, const Vec<Dim>& d) {
    const ParticleShape<Dim>& one = configuration.shape[i];
    const ParticleShape<Dim>& two = configuration.shape[j];
    // The circumcircles touch at a smaller factor than the largest one found, so this pair cannot matter.
    const double circles = one.circumradius() + two.circumradius();
    if (circles * circles < factor * factor * squared_norm(d)) return;
    const double f = perram_wertheim(one, orientation_of(configuration.pose(i)), two,
                                     orientation_of(configuration.pose(j)), d)
                         .value;
    factor = std::max(factor, 1 / std::sqrt(f));
  });
  return factor;
}

template double hard_margin(const Configuration2&);
template double hard_margin(const Configuration3&);
template std::optional<std::pair<std::size_t, std::size_t>> find_overlap(const Configuration2&);
template std::optional<std::pair<std::size_t, std::size_t>> find_overlap(const Configuration3&);
template double shrink_to_contact(const Configuration2&, double);
template double shrink_to_contact(const Configuration3&, double);

}  // namespace vitrel
