#include "core/state/contact_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/perram_wertheim.h"
#include "core/error.h"
#include "core/state/check.h"

namespace vitrel {
template <int Dim>
double contact_scale(const Configuration<Dim>& configuration, const PairImage<Dim>& pair) {
  const Vec<Dim> d = configuration.position[pair.j] - configuration.position[pair.i] +
                     configuration.box.translation(pair.shift);
  const auto one = configuration.pose(pair.i), two = configuration.pose(pair.j);
  return std::sqrt(perram_wertheim(configuration.shape[pair.i], orientation_of(one),
                                   configuration.shape[pair.j], orientation_of(two), d)
                       .value);
}

template <int Dim>
double shrink_to_contact(Configuration<Dim>& configuration) {
  // Each round removes the overlaps that rounding left in the round before; rounding errors grow with the aspect ratio.
  double margin = std::numeric_limits<double>::epsilon(), total = 1;
  for (auto check = exact_check(configuration); !check.clean();
       check = exact_check(configuration)) {
    double scale = 1 - margin;
    for (const PairImage<Dim>& pair : check.overlaps)
      scale = std::min(scale, contact_scale(configuration, pair) * (1 - margin));
    if (!(scale > 0)) {
      const PairImage<Dim>& pair = check.overlaps.front();
      throw InvariantError(
          fmt::format("two particles, like {} and {}, have one centre: no scaling separates them",
                      pair.i, pair.j));
    }
    for (ParticleShape<Dim>& shape : configuration.shape) shape = scaled(shape, scale);
    total *= scale;
    margin *= 2;
  }
  return total;
}

template double contact_scale(const Configuration2&, const PairImage<2>&);
template double contact_scale(const Configuration3&, const PairImage<3>&);
template double shrink_to_contact(Configuration2&);
template double shrink_to_contact(Configuration3&);

}  // namespace vitrel
