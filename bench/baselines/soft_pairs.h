#pragma once

#include <algorithm>
#include <vector>

#include "core/neighbors/pairs.h"
#include "edmd/soft/contact_force.h"

namespace vitrel::bench {

/// Two soft particles that are or may soon be in contact.
template <int Dim>
struct SoftPair {
  std::size_t i, j;
  Vec<Dim> translation;  ///< of the image of j
  ContactPair contact;

  /// The force on j, which is opposite to that on i. d points from centre i to the image of centre j. The force is
  /// along d, is never attractive, and vanishes beyond contact.
  template <ContactForce Force>
  Vec<Dim> force(const Force& law, const Vec<Dim>& d, const Vec<Dim>& relative_velocity) const {
    if (d.squaredNorm() >= contact.distance * contact.distance) return Vec<Dim>::Zero();
    const double r = d.norm(), rate = -d.dot(relative_velocity) / r;
    return std::max(0.0, law.force(contact.distance - r, rate, contact)) / r * d;
  }
};

/// Finds all pairs that are closer than contact and a margin. Wraps the positions.
template <int Dim>
std::vector<SoftPair<Dim>> find_soft_pairs(Configuration<Dim>& c, double margin) {
  for (std::size_t i = 0; i < c.size(); ++i) c.box.wrap(c.position[i], c.image[i]);
  std::vector<SoftPair<Dim>> pairs;
  // The scale satisfies (R₁ + R) scale ≥ R₁ + R₂ + margin for the largest radius R.
  for_each_pair(c, 1 + margin / largest_circumradius(c),
                [&](std::size_t i, std::size_t j, const Vec<Dim>& d) {
                  const double radius1 = c.shape[i].circumradius(),
                               radius2 = c.shape[j].circumradius();
                  if (d.norm() > radius1 + radius2 + margin) return;
                  pairs.push_back({i, j, d - (c.position[j] - c.position[i]),
                                   contact_pair(radius1, c.mass[i], radius2, c.mass[j])});
                });
  return pairs;
}

}  // namespace vitrel::bench
