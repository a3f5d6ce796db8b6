#pragma once

#include "core/random/stream.h"
#include "core/state/configuration.h"

/// Ideal gases: particles at independent random places, which may overlap.
namespace vitrel {

/// n particles of species A in a box; `complete(c, i)` gives the i-th what it has beside its place.
template <int Dim, class Complete>
Configuration<Dim> random_gas(std::size_t n, const Vec<Dim>& lengths, Stream& draw,
                              Complete&& complete) {
  Configuration<Dim> c;
  c.resize(n);
  c.species_names = {"A"};
  c.box = PeriodicBox<Dim>(lengths);
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < Dim; ++k) c.position[i][k] = lengths[k] * draw.uniform(-0.5, 0.5);
    complete(c, i);
  }
  return c;
}

template <int Dim>
Configuration<Dim> random_gas(std::size_t n, const Vec<Dim>& lengths, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  return random_gas(n, lengths, draw, [](Configuration<Dim>&, std::size_t) {});
}

}  // namespace vitrel
